#include "base/program_folder.h"

namespace fb {

// The one source file that knows where it was built; all others compile to the same wherever they lie.
std::filesystem::path programFolder() { return FB_SOURCE_DIR; }

}  // namespace fb
