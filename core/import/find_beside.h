// Finds the files that a model names (material files, buffers, textures) without ever leaving the model's
// folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fb {

struct FoundFile {
    std::filesystem::path file;  // canonical; empty when not found
    std::string why;             // when not found: "is missing", "lies outside the model's folder"
    bool byBareName = false;     // found by the last part of its name only, beside the model
};

// `name` as written in the model: relative to the model's folder, with / or \, upper and lower case as it
// comes. A path that leads outside (absolute, "..", a symbolic link) is not followed; like a missing one it
// is then looked for by its last part beside the model, which is where models that have moved keep their
// textures.
[[nodiscard]] FoundFile findBeside(const std::filesystem::path& model, std::string_view name);

// Images beside the model that go by its name: STEM.*, STEM_texture.*, and the same with the first word of
// the stem before '_'; sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> imagesNamedLike(const std::filesystem::path& model);

// "%20" becomes a space and so on (the URIs of glTF).
[[nodiscard]] std::string percentDecoded(std::string_view uri);

}  // namespace fb
