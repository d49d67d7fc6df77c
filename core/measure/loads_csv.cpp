#include "measure/loads_csv.h"

#include "measure/number_text.h"

namespace fb {
namespace {

std::string_view endName(LoadEnd end) {
    static constexpr std::string_view names[] = {"", "cancelled", "failed", "evicted"};
    return names[static_cast<std::size_t>(end)];
}

}  // namespace

std::string loadsCsv(const Hierarchy& h, std::span<const LoadRecord> loads, double beginSeconds) {
    std::string text =
        "node,level,bytes,missed_s,queued_s,first_read_s,read_s,decoded_s,uploaded_s,first_drawn_s,suspended,end,ended_s\n";
    for (const LoadRecord& load : loads) {
        appendNumber(text, load.node);
        text += ',';
        appendNumber(text, static_cast<unsigned>(h.level[load.node]));
        text += ',';
        appendNumber(text, load.bytes);
        for (const double at : {load.missedAt, load.queuedAt, load.firstReadAt, load.readAt, load.decodedAt, load.uploadedAt,
                                load.firstDrawnAt}) {
            text += ',';
            appendNumber(text, at - beginSeconds);
        }
        text += ',';
        appendNumber(text, load.suspensions);
        text += ',';
        text += endName(load.end);
        text += ',';
        appendNumber(text, load.endedAt - beginSeconds);
        text += '\n';
    }
    return text;
}

}  // namespace fb
