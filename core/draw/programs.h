// All shader programs of the renderer, compiled before the first frame. In: the shader folder. Out: programs,
// or the error of the first that does not compile.
#pragma once

#include <array>
#include <filesystem>

#include "draw/compile_shaders.h"
#include "draw/order_draws.h"

namespace fb {

struct Programs {
    std::array<GlProgram, kVariants>
        nodes;  // by kTextured | kLit | kMask | kLevel; kMask only with kTextured
    GlProgram sky, wire, boxes;
};

[[nodiscard]] Result<Programs> compilePrograms(const std::filesystem::path& shaderFolder);

}  // namespace fb
