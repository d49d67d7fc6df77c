// Which axis points up in a file that does not say. In: a cleaned mesh. Out: y or z with the reason, or nothing where
// the mesh gives no sign. Two signs are read, the first one that is clear counts:
// - A surface that is open below (terrain, a city, a scan on a table): all its areas times their normals add up to what
//   is missing, and point up. Those of a closed surface add up to nothing.
// - A flat base: area in the lowest hundredth of the extent that faces straight down.
#pragma once

#include <optional>
#include <string_view>

#include "import/source_scene.h"

namespace fb {

struct UpGuess {
    UpAxis up = UpAxis::y;
    std::string_view reason;
};

[[nodiscard]] std::optional<UpGuess> guessUp(const SourceMesh& mesh);

}  // namespace fb
