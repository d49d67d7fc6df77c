#include "measure/front_csv.h"

#include "measure/number_text.h"
#include "select/screen_error.h"

namespace fb {
namespace {

template <class Number>
void add(std::string& text, Number value) {
    text += ',';
    appendNumber(text, value);
}

}  // namespace

std::string frontCsv(const Hierarchy& h, std::span<const Reached> reached, std::span<const std::uint8_t> loaded,
                     const View& view) {
    std::string text = "node,level,block,reason,need_ms,had_ms,missing_nodes,missing_bytes,err_px,triangles,texture_bytes\n";
    for (const Reached& r : reached) {
        if (r.expanded) continue;
        std::uint32_t missing = 0;
        std::uint64_t bytes = 0;
        for (std::uint32_t i = 0; i < h.childCount[r.node]; ++i) {
            const NodeId child = h.firstChild[r.node] + i;
            if (loaded[child] != 0) continue;
            ++missing;
            bytes += h.residentBytes[child];
        }
        const bool asked = r.needMs != 0.0 || r.hadMs != 0.0;
        appendNumber(text, r.node);
        add(text, static_cast<unsigned>(h.level[r.node]));
        add(text, h.block[r.node]);
        text += ',' + std::string(boundByName(r.boundBy));
        text += ',';
        if (asked) appendNumber(text, r.needMs);
        text += ',';
        if (asked) appendNumber(text, r.hadMs);
        add(text, missing);
        add(text, bytes);
        add(text, nodeErrorPixels(h, r.node, view));
        add(text, h.triangles(r.node));
        add(text, h.textureBytes(r.node));
        text += '\n';
    }
    return text;
}

}  // namespace fb
