// The status bar: errors, the frame's time against its target, what binds, memory, the device.
#include <imgui.h>

#include <algorithm>
#include <array>

#include "load/residency.h"
#include "ui/panels.h"

namespace fb {
namespace {

// The reason that keeps most nodes of the front from being finer.
std::string_view whatBinds(const FrameRecord& record) {
    if (record.frontNodes == 0) return "nothing in view";
    if (record.infeasible) return "time: the roots alone take longer than the target";
    if (!record.moreDetailAvailable) return "nothing: every node in view is a leaf";
    // Leaves, and nodes whose children are out of view, are as fine as can be.
    std::array<std::uint32_t, kBoundByCount> nodes = record.boundBy;
    nodes[static_cast<std::size_t>(BoundBy::leaf)] = nodes[static_cast<std::size_t>(BoundBy::view)] = 0;
    return boundByName(static_cast<BoundBy>(std::ranges::max_element(nodes) - nodes.begin()));
}

}  // namespace

void drawStatusBar(const UiInput& input) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(" ");
    if (input.history.size() > 0) {
        const FrameRecord& r = input.history.newest();
        ImGui::SameLine();
        const std::string_view binds = whatBinds(r);
        ImGui::Text("%.1f of %.1f ms | %u nodes, %.0f K triangles | binds: %.*s | %.0f of %.0f MiB", r.actualMs, r.targetMs,
                    r.frontNodes, static_cast<double>(r.triangles) / 1e3, static_cast<int>(binds.size()), binds.data(),
                    static_cast<double>(r.residentBytes + r.reservedBytes) / kBytesPerMiB,
                    static_cast<double>(r.budgetBytes) / kBytesPerMiB);
    }
    ImGui::SameLine();
    ImGui::TextDisabled("| %.*s |", static_cast<int>(input.device.size()), input.device.data());
    ImGui::SameLine();
    if (input.errorCount > 0) {
        ImGui::TextColored(ImVec4(0.95f, 0.4f, 0.3f, 1.0f), "%u error%s", input.errorCount, input.errorCount == 1 ? "" : "s");
    } else {
        ImGui::TextDisabled("no errors");
    }
    if (input.message.empty()) return;
    ImGui::SameLine();
    const ImVec4 colour = input.messageIsError ? ImVec4(0.95f, 0.4f, 0.3f, 1.0f) : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::TextColored(colour, "| %.*s", static_cast<int>(input.message.size()), input.message.data());
}

}  // namespace fb
