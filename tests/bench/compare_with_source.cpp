// compare_with_source SCENE MESH... [--out FOLDER]: how near policy `full` on a built scene comes to the source that it
// was built from, drawn directly: triangles, area and peak signal-to-noise ratio from eight places of fly and walk.
// The meshes must be given as they were given to `frontbench build`; `city` is the built-in city. With --out the pictures of the worst view are saved.
#include <cstdio>

#include "app/save_picture.h"
#include "import/city.h"
#include "import/import_files.h"
#include "worlds/compare_with_source.h"

namespace {

int fail(const fb::Error& error) {
    std::fprintf(stderr, "compare_with_source: %s\n", error.oneLine().c_str());
    return 1;
}

}  // namespace

int main(int count, char** arguments) {
    std::vector<std::filesystem::path> meshes;
    std::filesystem::path out;
    for (int i = 2; i < count; ++i) {
        if (std::string_view(arguments[i]) == "--out" && i + 1 < count) out = arguments[++i];
        else meshes.emplace_back(arguments[i]);
    }
    if (meshes.empty()) {
        std::fprintf(stderr, "usage: compare_with_source SCENE MESH... [--out FOLDER]\n");
        return 2;
    }
    const auto source = meshes.front() == "city" ? fb::makeCity({}) : fb::importFiles(meshes, {}, nullptr);
    if (!source) return fail(source.error());
    const auto scene = fb::openScene(arguments[1]);
    if (!scene) return fail(scene.error());
    std::printf("%s: %llu triangles after clean-up\n", scene->info.name.c_str(),
                static_cast<unsigned long long>((*source)->info().report.keptTriangles));
    for (const char* path : {"fly", "walk"}) {
        const auto views = fb::test::compareWithSource({**source, arguments[1], path, 8});
        if (!views) return fail(views.error());
        std::size_t worst = 0;
        for (std::size_t v = 0; v < views->size(); ++v) {
            std::printf("  %s %zu: %.1f dB, ssim %.4f, %llu triangles drawn\n", path, v, (*views)[v].error.psnrDb,
                        (*views)[v].error.ssim, static_cast<unsigned long long>((*views)[v].drawnTriangles));
            if ((*views)[v].error.psnrDb < (*views)[worst].error.psnrDb) worst = v;
        }
        if (out.empty()) continue;
        const std::string name = std::string(path) + "-worst-";
        for (const auto& [kind, picture] : {std::pair("full", &(*views)[worst].full), {"source", &(*views)[worst].source}}) {
            if (const auto saved = fb::savePicture(*picture, out / (name + kind + ".png")); !saved) return fail(saved.error());
        }
    }
    return 0;
}
