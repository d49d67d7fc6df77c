// Where a GeoTIFF says that its pixels lie: pixel scale (tag 33550), tie point (33922), whether pixels are
// points (key 1025 of the directory in tag 34735), and GDAL's no-data value (tag 42113). OpenImageIO 2.4
// passes none of them on, so the file's first directory is read here; classic TIFF and BigTIFF, either byte
// order. GeoTIFF 1.1 (OGC 19-008r4) sections 7.1 and 7.2.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "base/result.h"

namespace fb {

struct GeoTags {
    std::optional<glm::dvec2> pixelMetres;      // east per column, south per row; both above 0
    std::optional<glm::dvec2> cornerEastNorth;  // of the first pixel's upper left corner
    std::optional<double> noData;
};

// Empty for files that are no TIFF; damaged tags count as missing, a file that cannot be read is an error.
[[nodiscard]] Result<GeoTags> readGeoTags(const std::filesystem::path& file);

}  // namespace fb
