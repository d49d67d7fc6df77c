// The built-in procedural city: data like the thesis's rather than boxes. A street grid of blocks whose facades are
// scanned-like meshes (about 10 cm spacing, noise, recessed windows, ledges, doors), with roofs and ground, a unique
// texture per facade, and about a tenth of the triangles untextured grey.
// Deterministic per seed on every machine; blocks are made one at a time, so the city may be larger than memory.
#pragma once

#include <cstdint>
#include <memory>

#include "import/source_scene.h"

namespace fb {

struct CityOptions {
    std::uint64_t blocks = 36;
    std::uint64_t triangles = 1600000;   // of the whole city; met within 5 %
    std::uint64_t texels = 80000000;     // of the whole city; met within 10 %
    std::uint64_t seed = 1;
    bool terrain = false;  // on hills, with the country around it as a terrain
};

// Refused: 0 blocks, too few triangles or texels for the blocks, more than the caps.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> makeCity(const CityOptions& options);

}  // namespace fb
