#include "draw/programs.h"

namespace fb {

namespace {

Result<void> compileInto(GlProgram& program, const std::filesystem::path& folder, const ProgramFiles& files) {
    auto compiled = compileProgram(folder, files);
    if (!compiled) return passOn(compiled);
    program = std::move(*compiled);
    return {};
}

}  // namespace

Result<Programs> compilePrograms(const std::filesystem::path& shaderFolder) {
    Programs programs;
    for (std::uint32_t variant = 0; variant < kVariants; ++variant) {
        if ((variant & kMask) != 0 && (variant & kTextured) == 0) continue;
        std::array<std::string_view, 4> defines;
        std::size_t count = 0;
        if ((variant & kTextured) != 0) defines[count++] = "TEXTURED";
        if ((variant & kLit) != 0) defines[count++] = "LIT";
        if ((variant & kMask) != 0) defines[count++] = "MASK";
        if ((variant & kLevel) != 0) defines[count++] = "LEVEL";
        const ProgramFiles files{"node.vert", "node.frag", std::span(defines).first(count)};
        if (auto done = compileInto(programs.nodes[variant], shaderFolder, files); !done) return passOn(done);
    }
    if (auto done = compileInto(programs.sky, shaderFolder, {"sky.vert", "sky.frag", {}}); !done)
        return passOn(done);
    if (auto done = compileInto(programs.wire, shaderFolder, {"wire.vert", "wire.frag", {}}); !done)
        return passOn(done);
    if (auto done = compileInto(programs.boxes, shaderFolder, {"box.vert", "box.frag", {}}); !done)
        return passOn(done);
    return programs;
}

}  // namespace fb
