// Opens a height map (TIFF, PNG or OpenEXR) with an optional picture on it and places it under the meshes of
// a scene, or alone. Comes from the command line; the BlockSource goes to build/. Size and place: a GeoTIFF's
// pixel scale and tie point; --cell-size beats the scale; where nothing is known, 1 m. Coordinates are
// easting and northing: x is east, and north is -z where y is up and +y where z is up. A map with coordinates
// goes where they say, if it lies under the meshes or there are none; any other map has its middle under the
// middle of the meshes, or at the origin. Heights are never moved. A picture with coordinates of its own goes
// where they say too, any other is stretched over the whole map, edge to edge of the outer pixels.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "import/source_scene.h"
#include "import/terrain_source.h"

namespace fb {

struct TerrainOptions {
    std::filesystem::path heights;
    std::optional<std::filesystem::path> drape;
    std::optional<double> cellMetres;
    double heightScale = 1.0;      // metres a unit of the file
    std::optional<double> noData;  // in the file's units; default: what a GeoTIFF says
    std::optional<UpAxis> up;      // default: the meshes', else y
    std::string name;              // default: the meshes', else the file's stem
};

// `meshes` may be null. The whole map is read once, to learn what is known of it; nothing of it is kept.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> addTerrain(std::unique_ptr<BlockSource> meshes,
                                                              const TerrainOptions& options);

// Reads through `source` once and fills in the range of heights. Refused: a map without a cell, one of which
// nothing is known. Gives the number of samples that are not known.
[[nodiscard]] Result<std::uint64_t> surveyTerrain(const TerrainSource& source, TerrainInfo& info);

// A square way of at most 120 m a side on the ground around the middle, where the ground is known; else none.
[[nodiscard]] Result<std::optional<WalkHint>> walkOnTerrain(const TerrainSource& source);

}  // namespace fb
