// Material files of OBJ: name, diffuse colour, opacity, the textures of both, and how the texture is laid on.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fb {

struct MtlMaterial {
    std::string name;
    glm::vec4 colour{1.0f};    // Kd and d; white where the file gives no Kd
    std::string texture;       // map_Kd
    std::string alphaTexture;  // map_d
    glm::vec2 uvScale{1.0f},
        uvOffset{0.0f};  // -s and -o of map_Kd, in the file's convention (v from the bottom)
};

// Never fails: what is not understood is left out, as MTL has many dialects. Of materials of one name the
// first counts.
[[nodiscard]] std::vector<MtlMaterial> parseMtl(std::string_view text);

}  // namespace fb
