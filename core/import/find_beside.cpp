#include "import/find_beside.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include "import/parse_text.h"

namespace fb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameLength = 4096;

fs::path folderOf(const fs::path& model) {
    std::error_code problem;
    const fs::path folder = model.has_parent_path() ? model.parent_path() : fs::path(".");
    return fs::canonical(folder, problem);
}

bool isInside(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

std::vector<fs::path> sortedEntries(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code problem;
    for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
        entries.push_back(it->path());
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

// Follows `name` part by part; a part that does not exist may differ in upper and lower case.
fs::path matched(const fs::path& folder, const fs::path& name) {
    std::error_code problem;
    fs::path at = folder;
    for (const fs::path& part : name) {
        fs::path next = at / part;
        if (!fs::exists(next, problem)) {
            const std::string wanted = lowerCase(part.string());
            for (const fs::path& entry : sortedEntries(at)) {
                if (lowerCase(entry.filename().string()) != wanted) continue;
                next = entry;
                break;
            }
        }
        at = next;
    }
    return at;
}

FoundFile findExactly(const fs::path& folder, const fs::path& name) {
    std::error_code problem;
    if (name.is_absolute() && !isInside(folder, name.lexically_normal())) {
        return {{}, "lies outside the model's folder", false};
    }
    const fs::path file = fs::canonical(matched(folder, name), problem);
    if (problem) {
        const bool outside = !isInside(folder, (folder / name).lexically_normal());
        return {{}, outside ? "lies outside the model's folder" : "is missing", false};
    }
    if (!isInside(folder, file)) return {{}, "lies outside the model's folder", false};
    if (!fs::is_regular_file(file, problem)) return {{}, "is not a file", false};
    return {file, {}, false};
}

bool isDrivePath(std::string_view name) {
    return name.size() > 2 && name[1] == ':' && name[2] == '/';
}

}  // namespace

FoundFile findBeside(const fs::path& model, std::string_view name) {
    std::string portable(trimmed(name));
    if (portable.size() >= 2 && portable.front() == '"' && portable.back() == '"') {
        portable = portable.substr(1, portable.size() - 2);
    }
    std::replace(portable.begin(), portable.end(), '\\', '/');
    const bool usable =
        !portable.empty() && portable.size() <= kMaxNameLength && portable.find('\0') == std::string::npos;
    const fs::path folder = folderOf(model);
    if (!usable || folder.empty()) return {{}, "is missing", false};

    FoundFile found = isDrivePath(portable) ? FoundFile{{}, "lies outside the model's folder", false}
                                            : findExactly(folder, portable);
    const fs::path bare = fs::path(portable).filename();
    if (!found.file.empty() || bare.empty() || bare == ".." || bare == "." || bare == fs::path(portable))
        return found;
    FoundFile beside = findExactly(folder, bare);
    if (beside.file.empty()) return found;
    beside.byBareName = true;
    return beside;
}

std::vector<fs::path> imagesNamedLike(const fs::path& model) {
    constexpr std::array kExtensions{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".tga", ".webp"};
    const std::string stem = lowerCase(model.stem().string());
    const std::string firstWord = stem.substr(0, stem.find('_'));
    std::vector<fs::path> images;
    for (const fs::path& entry : sortedEntries(folderOf(model))) {
        const std::string extension = lowerCase(entry.extension().string());
        if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) continue;
        const std::string name = lowerCase(entry.stem().string());
        const bool alike = name == stem || name == stem + "_texture" ||
                           (!firstWord.empty() && (name == firstWord || name == firstWord + "_texture"));
        if (alike && !findExactly(folderOf(model), entry.filename()).file.empty()) images.push_back(entry);
    }
    return images;
}

std::string percentDecoded(std::string_view uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            decoded += static_cast<char>(value);
            i += 2;
        } else {
            decoded += uri[i];
        }
    }
    return decoded;
}

}  // namespace fb
