// Shader programs from the files in shaders/. In: file names and definitions. Out: a linked program, or an
// error that names the file and the line. #include "NAME" is resolved here (OpenGL has no such thing). #line
// numbers lead back from the driver's messages: line N of file I is 10000 * I + N, because Mesa prints the
// number of a source string as 0 whatever #line says.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "draw/gl_objects.h"

namespace fb {

inline constexpr std::size_t kLinesPerFile = 10'000;

struct ProgramFiles {
    std::string_view vertex, fragment;          // in the shader folder
    std::span<const std::string_view> defines;  // names, defined without a value
};

[[nodiscard]] Result<GlProgram> compileProgram(const std::filesystem::path& shaderFolder,
                                               const ProgramFiles& files);

// The text that the driver gets, and the files that went into it.
struct ShaderText {
    std::string text;
    std::vector<std::filesystem::path> files;
};
[[nodiscard]] Result<ShaderText> readShader(const std::filesystem::path& shaderFolder, std::string_view file,
                                            std::span<const std::string_view> defines);

// The first message of a driver's log as an error with file and line: "0:12(5): error: …" (Mesa), "0(12) :
// error …" (NVIDIA) or "ERROR: 0:12: …" (others).
[[nodiscard]] Error shaderError(const ShaderText& shader, std::string_view log);

}  // namespace fb
