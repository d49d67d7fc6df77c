#pragma once

namespace fb {

inline constexpr double kBytesPerMiB = 1048576.0;

}  // namespace fb
