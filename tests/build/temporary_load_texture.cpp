#include "import/source_scene.h"
namespace fb {
Result<Image> loadTexture(const SourceTexture& t) { if (t.image) return *t.image; return failure(t.name, "", "missing"); }
std::vector<std::string> ImportReport::lines() const { return {}; }
}
