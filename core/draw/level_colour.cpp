#include <array>

#include "draw/renderer.h"

namespace fb {

glm::vec3 levelColour(int level) {
    // Okabe and Ito (2008), coarse to fine, without black.
    static constexpr std::array<std::array<float, 3>, 7> kPalette = {{{0.835f, 0.369f, 0.000f},
                                                                      {0.902f, 0.624f, 0.000f},
                                                                      {0.941f, 0.894f, 0.259f},
                                                                      {0.000f, 0.620f, 0.451f},
                                                                      {0.337f, 0.706f, 0.914f},
                                                                      {0.000f, 0.447f, 0.698f},
                                                                      {0.800f, 0.475f, 0.655f}}};
    const auto& c = kPalette[static_cast<std::size_t>(level < 0 ? 0 : level) % kPalette.size()];
    return {c[0], c[1], c[2]};
}

}  // namespace fb
