// How much one picture differs from another: peak signal-to-noise ratio and structural similarity. The
// renderer's picture and the reference's (policy `full`) go in; numbers for the report and the accuracy panel
// come out. SSIM: Wang, Bovik, Sheikh, Simoncelli 2004, Gaussian window of 11x11 and sigma 1.5 on luma.
#pragma once

#include <span>

#include "base/result.h"
#include "import/source_scene.h"

namespace fb {

struct ImageError {
    double meanSquaredError = 0.0;  // over all pixels and colour channels, 8-bit values
    double psnrDb = 0.0;            // 10 log10(255^2 / mean squared error); infinity for identical pictures
    double ssim = 1.0;              // in [-1, 1], 1 for identical pictures
};

// Alpha is left out; a grey picture beside a coloured one counts as coloured. Refused: pictures of different
// sizes or without pixels. The SSIM windows lie wholly inside the picture; in one smaller than 11 pixels they
// shrink to fit.
[[nodiscard]] Result<ImageError> compareImages(const Image& picture, const Image& reference);

// Over several pairs: psnrDb is that of the mean of the squared errors, so identical pairs count and do not
// make it infinite unless all are.
struct ImageErrorSummary {
    std::size_t pictures = 0;
    double psnrDb = 0.0, worstPsnrDb = 0.0;
    double ssim = 1.0, worstSsim = 1.0;
};
[[nodiscard]] ImageErrorSummary summariseImageErrors(std::span<const ImageError> errors);

}  // namespace fb
