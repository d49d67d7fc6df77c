#include "draw/compile_shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "base/file_io.h"

namespace fb {

namespace {

constexpr std::uint64_t kMostShaderBytes = 1 << 20;
constexpr std::size_t kMostIncludes = 32;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
    return text;
}

// The name in #include "NAME"; <NAME> is C++'s and stands behind #ifdef __cplusplus.
std::optional<std::string_view> includedName(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with("#include")) return std::nullopt;
    line = trimmed(line.substr(8));
    if (line.size() < 3 || line.front() != '"' || line.back() != '"') return std::nullopt;
    return line.substr(1, line.size() - 2);
}

Result<void> appendFile(const std::filesystem::path& folder, std::string_view name,
                        std::span<const std::string_view> defines, ShaderText& shader) {
    const std::filesystem::path path = folder / name;
    for (const auto& already : shader.files) {
        if (already == path) return {};  // each file once, as with #pragma once
    }
    if (shader.files.size() >= kMostIncludes) return failure(path.string(), "", "too many included files");
    auto bytes = readFile(path, kMostShaderBytes);
    if (!bytes) return passOn(bytes);
    const std::size_t index = shader.files.size();
    shader.files.push_back(path);
    const auto lineMark = [&](std::size_t line) {
        shader.text += "#line " + std::to_string(index * kLinesPerFile + line) + "\n";
    };
    if (index > 0) lineMark(1);
    std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view text = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (const auto include = includedName(text)) {
            if (auto added = appendFile(folder, *include, {}, shader); !added) {
                added.error().hint = "included by " + path.string() + " line " + std::to_string(line);
                return added;
            }
            lineMark(line + 1);
            continue;
        }
        shader.text.append(text).push_back('\n');
        if (trimmed(text).starts_with("#version")) {
            for (std::string_view define : defines)
                shader.text.append("#define ").append(define).append(" 1\n");
            lineMark(line + 1);
        }
    }
    return {};
}

std::string logOf(unsigned name, void (*getLength)(GLuint, GLenum, GLint*),
                  void (*getLog)(GLuint, GLsizei, GLsizei*, GLchar*)) {
    GLint length = 0;
    getLength(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length < 1 ? 1 : length), '\0');
    GLsizei written = 0;
    getLog(name, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written < 0 ? 0 : written));
    return log;
}

Result<GlShader> compileStage(unsigned type, const std::filesystem::path& folder, std::string_view file,
                              std::span<const std::string_view> defines) {
    auto text = readShader(folder, file, defines);
    if (!text) return passOn(text);
    GlShader shader = GlShader::make(type);
    const char* source = text->text.c_str();
    glShaderSource(shader.name(), 1, &source, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    return tl::make_unexpected(shaderError(
        *text, logOf(
                   shader.name(), [](GLuint n, GLenum w, GLint* v) { glGetShaderiv(n, w, v); },
                   [](GLuint n, GLsizei s, GLsizei* l, GLchar* t) { glGetShaderInfoLog(n, s, l, t); })));
}

// Reads digits at `at` and moves behind them.
std::optional<std::size_t> numberAt(std::string_view text, std::size_t& at) {
    if (at >= text.size()) return std::nullopt;
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    at = static_cast<std::size_t>(end - text.data());
    return value;
}

}  // namespace

Result<ShaderText> readShader(const std::filesystem::path& shaderFolder, std::string_view file,
                              std::span<const std::string_view> defines) {
    ShaderText shader;
    if (auto added = appendFile(shaderFolder, file, defines, shader); !added) return passOn(added);
    return shader;
}

Error shaderError(const ShaderText& shader, std::string_view log) {
    Error error;
    error.file = shader.files.empty() ? std::string() : shader.files.front().string();
    const std::string_view message = trimmed(trimmed(log).substr(0, trimmed(log).find('\n')));
    std::string_view what = message;
    for (std::size_t at = 0; at < message.size(); ++at) {
        if (std::isdigit(static_cast<unsigned char>(message[at])) == 0) continue;
        std::size_t end = at;
        const bool isString = numberAt(message, end).has_value();
        const bool opens = isString && end < message.size() && (message[end] == ':' || message[end] == '(');
        std::size_t behind = end + 1;
        const auto line = opens ? numberAt(message, behind) : std::nullopt;
        at = end;
        if (!line || *line / kLinesPerFile >= shader.files.size()) continue;
        error.file = shader.files[*line / kLinesPerFile].string();
        error.place = "line " + std::to_string(*line % kLinesPerFile);
        what = message.substr(behind);
        if (what.starts_with('(')) what.remove_prefix(std::min(what.find(')'), what.size()));
        what.remove_prefix(std::min(what.find_first_not_of("): "), what.size()));
        break;
    }
    error.reason = "the driver does not compile it: " + std::string(what);
    return error;
}

Result<GlProgram> compileProgram(const std::filesystem::path& shaderFolder, const ProgramFiles& files) {
    auto vertex = compileStage(GL_VERTEX_SHADER, shaderFolder, files.vertex, files.defines);
    if (!vertex) return passOn(vertex);
    auto fragment = compileStage(GL_FRAGMENT_SHADER, shaderFolder, files.fragment, files.defines);
    if (!fragment) return passOn(fragment);
    GlProgram program = GlProgram::make();
    glAttachShader(program.name(), vertex->name());
    glAttachShader(program.name(), fragment->name());
    glLinkProgram(program.name());
    glDetachShader(program.name(), vertex->name());
    glDetachShader(program.name(), fragment->name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    const std::string log = logOf(
        program.name(), [](GLuint n, GLenum w, GLint* v) { glGetProgramiv(n, w, v); },
        [](GLuint n, GLsizei s, GLsizei* l, GLchar* t) { glGetProgramInfoLog(n, s, l, t); });
    return failure(
        (shaderFolder / files.fragment).string(), "",
        "the driver does not link it with " + std::string(files.vertex) + ": " + std::string(trimmed(log)));
}

}  // namespace fb
