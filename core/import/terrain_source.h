// A height map as the builder of terrains takes it: heights and, where there is one, the picture that covers
// them, both read row by row from the top, so that neither need fit into memory. Comes from an image file
// (open_terrain.h) or from the generated country around the city; goes to build/build_terrain.h. A sample is
// a vertex; four samples around one cell that are all known make two triangles, other cells are holes.
// Columns run east. Rows run south: along +z where y is up and along -y where z is up.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "base/result.h"
#include "import/source_scene.h"

namespace fb {

struct TerrainInfo {
    std::string name;
    std::uint32_t columns = 0, rows = 0;  // of samples, at least 2 each
    glm::dvec2 cellMetres{1.0};           // between columns and between rows
    glm::dvec3 firstSample{0.0};          // its place at height 0, relative to the scene's origin
    UpAxis up = UpAxis::y;
    float lowestMetres = 0.0f, highestMetres = 0.0f;  // of all heights that are known
    std::uint64_t sourceHash = 0;                     // of heights, picture and placement

    int drapeWidth = 0, drapeHeight = 0;  // texels; 0 without a picture
    glm::dvec2 drapeFirst{0.5};  // texel coordinates of the first sample; (0,0) is the picture's corner
    glm::dvec2 texelsPerCell{1.0};
    bool drapeLossless = false;

    [[nodiscard]] bool hasDrape() const { return drapeWidth > 0; }
};

// `rows` holds whole rows from `firstRow` on, in order; the rows of a picture are RGB bytes.
using TakeHeights = std::function<Result<void>(std::uint32_t firstRow, std::span<const float> rows)>;
using TakeTexels = std::function<Result<void>(std::uint32_t firstRow, std::span<const std::uint8_t> rows)>;

class TerrainSource {
  public:
    virtual ~TerrainSource() = default;
    [[nodiscard]] virtual const TerrainInfo& info() const = 0;
    // Metres above height 0; NaN where nothing is known. Infinite and absurd heights do not come.
    [[nodiscard]] virtual Result<void> readHeights(const TakeHeights& take) const = 0;
    [[nodiscard]] virtual Result<void> readDrape(const TakeTexels& take) const = 0;
};

}  // namespace fb
