// Shader programs from the files in shaders/. In: file names and definitions. Out: a linked program, or an error that
// names the file and the line. #include "NAME" is resolved here (OpenGL has no such thing), with #line so that the
// driver's messages lead back to the right file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "draw/gl_objects.h"

namespace fb {

struct ProgramFiles {
    std::string_view vertex, fragment;           // in the shader folder
    std::span<const std::string_view> defines;  // names, defined without a value
};

[[nodiscard]] Result<GlProgram> compileProgram(const std::filesystem::path& shaderFolder, const ProgramFiles& files);

// The text that the driver gets, and the files that went into it: #line N I means line N of file I.
struct ShaderText {
    std::string text;
    std::vector<std::filesystem::path> files;
};
[[nodiscard]] Result<ShaderText> readShader(const std::filesystem::path& shaderFolder, std::string_view file,
                                            std::span<const std::string_view> defines);

// The first message of a driver's log, "0:12(5): error: …" (Mesa), "0(12) : error …" (NVIDIA) or "ERROR: 0:12: …",
// as an error with file and line.
[[nodiscard]] Error shaderError(const ShaderText& shader, std::string_view log);

}  // namespace fb
