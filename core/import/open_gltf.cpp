#include "import/open_gltf.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file_io.h"
#include "import/find_beside.h"
#include "import/import_limits.h"
#include "import/parse_bytes.h"
#include "import/parse_text.h"

namespace fb {
namespace {

using nlohmann::json;

constexpr int kMaxJsonDepth = 200;
constexpr std::size_t kMaxBuffers = 10000;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

// What a file may require: read here, or without influence on shape and base colour.
constexpr std::array<std::string_view, 8> kSupported{
    "KHR_texture_transform", "KHR_mesh_quantization", "EXT_texture_webp", "KHR_lights_punctual",
    "KHR_animation_pointer", "KHR_xmp_json_ld",       "KHR_xmp",          "EXT_lights_image_based"};
constexpr std::string_view kLooksOnly = "KHR_materials_";
// What a file may use without requiring it and still means another shape than the one that is read.
constexpr std::array<std::string_view, 2> kMissed{"EXT_mesh_gpu_instancing", "CESIUM_RTC"};

// Files that tinygltf may ask for: the buffers, by name as they stand in the JSON.
struct Buffers {
    const std::filesystem::path& model;
    std::map<std::string, std::uint64_t> sizes;  // decoded URI to byteLength
    std::vector<std::filesystem::path>& readFiles;
};

bool exists(const std::string& name, void* user) {
    return static_cast<Buffers*>(user)->sizes.count(name) > 0;
}
std::string unchanged(const std::string& name, void*) {
    return name;
}

bool readBuffer(std::vector<unsigned char>* bytes, std::string* problem, const std::string& name,
                void* user) {
    auto& buffers = *static_cast<Buffers*>(user);
    const FoundFile found = findBeside(buffers.model, name);
    if (found.file.empty()) {
        *problem += "the buffer " + inQuotes(name) + " " + found.why;
        return false;
    }
    Result<std::vector<std::uint8_t>> read = readFile(found.file, kMaxMeshFileBytes);
    if (!read) {
        *problem += read.error().oneLine();
        return false;
    }
    const std::uint64_t size = buffers.sizes.at(name);
    if (read->size() < size) {
        *problem += "the buffer " + inQuotes(name) + " has " + std::to_string(read->size()) + " of " +
                    std::to_string(size) + " bytes";
        return false;
    }
    read->resize(size);
    *bytes = std::move(*read);
    buffers.readFiles.push_back(found.file);
    return true;
}

// Keeps the encoded bytes of images inside the JSON; those in buffer views are taken from there later.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

Result<std::string_view> jsonOfGlb(const MeshBytes& input) {
    const std::uint64_t size = input.bytes.size();
    const auto number = [&](std::uint64_t at) {
        return loadNumber<std::uint32_t>(input.bytes.data() + at, false);
    };
    const auto cutOff = [&](std::uint64_t promised) {
        return input.failure("byte " + std::to_string(size),
                             "the file ends here and should have " + std::to_string(promised) + " bytes",
                             "the file is cut off");
    };
    if (size < 20) return cutOff(20);
    if (number(4) != 2) return input.failure("byte 4", "only version 2 of GLB can be read");
    if (number(8) > size) return cutOff(number(8));
    if (number(16) != kJsonChunk) return input.failure("byte 16", "the first chunk is not JSON");
    for (std::uint64_t at = 12; at < number(8);) {
        const std::uint64_t end = at + 8 + (at + 8 <= number(8) ? number(at) : 0);
        if (end > number(8))
            return input.failure("byte " + std::to_string(at), "the chunk is longer than the file");
        if (at > 12 && number(at + 4) == kBinaryChunk && number(at) % 4 != 0) {
            return input.failure("byte " + std::to_string(at), "the chunk's length is no multiple of 4");
        }
        at = end;
    }
    return input.text().substr(20, number(12));
}

std::optional<std::uint64_t> unsignedMember(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::uint64_t>();
}

std::string stringMember(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

const json& arrayMember(const json& document, const char* key) {
    static const json kEmpty = json::array();
    const auto found = document.find(key);
    return found != document.end() && found->is_array() ? *found : kEmpty;
}

Result<json> parseJson(const MeshBytes& input, std::string_view text) {
    bool tooDeep = false;
    const auto watch = [&](int depth, json::parse_event_t, json&) {
        tooDeep = tooDeep || depth > kMaxJsonDepth;
        return !tooDeep;
    };
    json document = json::parse(text.begin(), text.end(), watch, false);
    if (tooDeep) return input.failure({}, "its JSON is nested too deeply");
    if (document.is_discarded())
        return input.failure({}, "its JSON cannot be parsed", "the file is cut off or damaged");
    if (!document.is_object()) return input.failure({}, "its JSON is not an object");
    return document;
}

Result<void> checkVersion(const MeshBytes& input, const json& document) {
    const auto asset = document.find("asset");
    const std::string version =
        asset != document.end() && asset->is_object() ? stringMember(*asset, "version") : std::string();
    if (startsWith(version, "2.")) return {};
    return input.failure({},
                         version.empty() ? "says no version: it is not glTF" : "is glTF " + inQuotes(version),
                         "only glTF 2.0 can be read");
}

Result<void> checkExtensions(const MeshBytes& input, const json& document, ImportReport& report) {
    std::string refused;
    for (const json& name : arrayMember(document, "extensionsRequired")) {
        if (!name.is_string()) continue;
        const auto text = name.get<std::string>();
        const bool known = startsWith(text, kLooksOnly) ||
                           std::find(kSupported.begin(), kSupported.end(), text) != kSupported.end();
        if (!known) refused += (refused.empty() ? "" : ", ") + text;
    }
    if (!refused.empty()) {
        return input.failure({}, "requires what cannot be read: " + refused, "export it without compression");
    }
    for (const json& name : arrayMember(document, "extensionsUsed")) {
        if (!name.is_string()) continue;
        const auto text = name.get<std::string>();
        if (std::find(kMissed.begin(), kMissed.end(), text) == kMissed.end()) continue;
        report.warnings.push_back(input.file.filename().string() + " uses " + text +
                                  ", which is not read: parts may be missing or in another place");
    }
    return {};
}

// Collects the sizes of buffers and holds the views against them.
Result<void> checkBuffers(const MeshBytes& input, const json& document, Buffers& buffers) {
    std::vector<std::uint64_t> sizes;
    std::uint64_t sum = 0;
    for (const json& buffer : arrayMember(document, "buffers")) {
        const std::string place = "buffer " + std::to_string(sizes.size());
        const std::uint64_t size = buffer.is_object() ? unsignedMember(buffer, "byteLength").value_or(0) : 0;
        if (size == 0) return input.failure(place, "has no byteLength");
        const std::string uri = stringMember(buffer, "uri");
        if (uri.empty() && !sizes.empty())
            return input.failure(place, "has no uri, which only the first may lack");
        if (!uri.empty() && !startsWith(uri, "data:")) buffers.sizes[percentDecoded(uri)] = size;
        sizes.push_back(size);
        sum += std::min(size, kMaxMeshFileBytes);
        if (sum > kMaxMeshFileBytes || sizes.size() > kMaxBuffers) {
            return input.failure(place, "the buffers are larger than can be read");
        }
    }
    std::size_t index = 0;
    for (const json& view : arrayMember(document, "bufferViews")) {
        const std::string place = "bufferView " + std::to_string(index++);
        if (!view.is_object()) return input.failure(place, "is not an object");
        const std::uint64_t buffer = unsignedMember(view, "buffer").value_or(sizes.size());
        if (buffer >= sizes.size()) return input.failure(place, "has no buffer");
        const std::uint64_t offset = unsignedMember(view, "byteOffset").value_or(0);
        const std::uint64_t length = unsignedMember(view, "byteLength").value_or(0);
        if (offset > sizes[buffer] || length > sizes[buffer] - offset) {
            return input.failure(place, "reaches beyond the end of its buffer", "the file is damaged");
        }
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<tinygltf::Model>> openGltf(const MeshBytes& input, MeshFile& into,
                                                  ImportReport& report) {
    const bool isGlb = startsWith(input.text(), "glTF");
    std::string_view text = input.text();
    if (isGlb) {
        Result<std::string_view> chunk = jsonOfGlb(input);
        if (!chunk) return passOn(chunk);
        text = *chunk;
    }
    Result<json> document = parseJson(input, text);
    if (!document) return passOn(document);
    Buffers buffers{input.file, {}, into.otherFiles};
    if (Result<void> checked = checkVersion(input, *document); !checked) return passOn(checked);
    if (Result<void> checked = checkExtensions(input, *document, report); !checked) return passOn(checked);
    if (Result<void> checked = checkBuffers(input, *document, buffers); !checked) return passOn(checked);
    if (input.bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        return input.failure({}, "is larger than 4 GiB", "keep its buffers in files of their own");
    }

    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keepEncoded, nullptr);
    tinygltf::FsCallbacks files{exists, unchanged, readBuffer, nullptr, &buffers};
    parser.SetFsCallbacks(files);
    auto model = std::make_unique<tinygltf::Model>();
    std::string problem, warning;
    const auto size = static_cast<unsigned int>(input.bytes.size());
    bool parsed = false;
    try {
        parsed = isGlb
                     ? parser.LoadBinaryFromMemory(model.get(), &problem, &warning, input.bytes.data(), size)
                     : parser.LoadASCIIFromString(model.get(), &problem, &warning, text.data(), size, "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& thrown) {
        problem += thrown.what();
    }
    if (!parsed) {
        return input.failure({}, "is not valid glTF: " + std::string(trimmed(problem)),
                             "the file is damaged");
    }
    return model;
}

}  // namespace fb
