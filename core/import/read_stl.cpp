#include <array>

#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/parse_text.h"
#include "import/stl_layout.h"

namespace fb {
namespace {

// The normals of STL say no more than the corners' order does, and are often 0: they are not read. Each
// triangle has corners of its own; cleanMesh joins them.
Result<MeshFile> readBinary(const MeshBytes& input, ImportReport& report) {
    const std::span<const std::uint8_t> bytes = input.bytes;
    if (bytes.size() < kStlHeaderBytes) {
        return input.failure("byte " + std::to_string(bytes.size()), "the file ends inside the header",
                             "the file is cut off or not STL");
    }
    const std::uint64_t count = loadNumber<std::uint32_t>(bytes.data() + 80, false);
    const std::uint64_t most = (bytes.size() - kStlHeaderBytes) / kStlTriangleBytes;
    if (count > most) {
        return input.failure("byte 80",
                             "the header promises " + std::to_string(count) +
                                 " triangles, the rest of the file can hold " + std::to_string(most),
                             "the file is cut off or not STL");
    }
    if (count > kMaxTriangles || 3 * count > kMaxVertices) {
        return input.failure("byte 80", "has more triangles than can be read", "cut it into several files");
    }
    if (kStlHeaderBytes + count * kStlTriangleBytes < bytes.size()) {
        report.warnings.push_back(input.file.filename().string() +
                                  ": what stands behind the last triangle was left out");
    }
    MeshFile file;
    SourceMesh& mesh = file.block.mesh;
    mesh.positions.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::uint64_t t = 0; t < count; ++t) {
        const std::uint8_t* const corners = bytes.data() + kStlHeaderBytes + t * kStlTriangleBytes + 12;
        for (int i = 0; i < 9; i += 3) {
            mesh.positions.emplace_back(loadNumber<float>(corners + 4 * i, false),
                                        loadNumber<float>(corners + 4 * i + 4, false),
                                        loadNumber<float>(corners + 4 * i + 8, false));
        }
        const auto first = static_cast<std::uint32_t>(3 * t);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh.materials.assign(count, kNoMaterial);
    report.sourceTriangles += count;
    return file;
}

class AsciiReader {
  public:
    AsciiReader(const MeshBytes& input, ImportReport& report)
        : input_(input), report_(report), words_(input.text()) {}

    Result<MeshFile> read() {
        std::string_view word = words_.next();
        while (!word.empty()) {
            if (lowerCase(word) != "solid") return wrong("solid", word);
            file_.groupNames.emplace_back(words_.restOfLine());
            if (Result<void> taken = takeSolid(); !taken) return passOn(taken);
            word = words_.next();
        }
        if (file_.groupNames.size() < 2) {
            file_.groupNames.clear();
            file_.groups.clear();
        }
        return std::move(file_);
    }

  private:
    [[nodiscard]] tl::unexpected<Error> wrong(std::string_view wanted, std::string_view found) const {
        if (found.empty()) {
            return input_.failure(words_.place(),
                                  "the file ends where '" + std::string(wanted) + "' should follow",
                                  "the file is cut off");
        }
        return input_.failure(words_.place(),
                              inQuotes(found) + " stands where '" + std::string(wanted) + "' should");
    }

    Result<void> take(std::string_view wanted) {
        const std::string_view word = words_.next();
        if (lowerCase(word) != wanted) return wrong(wanted, word);
        return {};
    }

    Result<void> takeSolid() {
        while (true) {
            const std::string_view word = words_.next();
            if (lowerCase(word) == "endsolid") return (void)words_.restOfLine(), Result<void>{};
            if (lowerCase(word) != "facet") return wrong("facet", word);
            (void)words_.restOfLine();  // the normal
            if (Result<void> taken = takeFacet(); !taken) return taken;
        }
    }

    Result<void> takeFacet() {
        for (const char* wanted : {"outer", "loop"}) {
            if (Result<void> taken = take(wanted); !taken) return taken;
        }
        SourceMesh& mesh = file_.block.mesh;
        const std::size_t first = mesh.positions.size();
        std::string_view word = words_.next();
        for (; lowerCase(word) == "vertex"; word = words_.next()) {
            std::array<double, 3> n{};
            for (double& value : n) {
                const std::string_view number = words_.next();
                if (!toReal(number, value)) return wrong("a number", number);
            }
            mesh.positions.emplace_back(n[0], n[1], n[2]);
        }
        if (lowerCase(word) != "endloop") return wrong("endloop", word);
        if (mesh.positions.size() > kMaxVertices) {
            return input_.failure(words_.place(), "has more triangles than can be read",
                                  "cut it into several files");
        }
        corners_.clear();
        for (std::size_t v = first; v < mesh.positions.size(); ++v)
            corners_.push_back(static_cast<std::uint32_t>(v));
        const auto group = static_cast<std::uint32_t>(file_.groupNames.size() - 1);
        addPolygon(file_, corners_, kNoMaterial, group, report_);
        return take("endfacet");
    }

    const MeshBytes& input_;
    ImportReport& report_;
    TextWords words_;
    MeshFile file_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

Result<MeshFile> readStl(const MeshBytes& input, ImportReport& report) {
    TextWords words(input.text());
    if (!isBinaryStl(input.bytes) && lowerCase(words.next()) == "solid") {
        // A damaged binary file may begin with 'solid' as well; text has no byte 0.
        const std::string_view front = input.text().substr(0, 512);
        if (front.find('\0') == std::string_view::npos) return AsciiReader(input, report).read();
    }
    return readBinary(input, report);
}

}  // namespace fb
