#include "base/file_io.h"
#include "measure/replay_figures.h"
#include "measure/report.h"

namespace fb {

Result<void> writeReport(const ReplayReport& report, const std::filesystem::path& folder) {
    const std::filesystem::path plots = folder / "plots";
    if (Result<void> made = makeFolder(plots); !made) return made;
    if (Result<void> written = writeFileAtomically(folder / "frames.csv", framesCsv(report)); !written)
        return written;
    if (Result<void> written = writeFileAtomically(folder / "loads.csv", report.loadsCsv); !written) return written;
    if (Result<void> written = writeFileAtomically(folder / "summary.json", summaryJson(report)); !written) {
        return written;
    }
    for (const auto& [name, figure] : replayFigures(report)) {
        const Drawing drawing = layOut(figure);
        Result<void> written =
            writeFileAtomically(plots / (name + ".svg"), drawingSvg(drawing, figure.title));
        if (!written) return written;
        Result<std::vector<std::uint8_t>> png = pngBytes(rasterise(drawing));
        if (!png) return passOn(png);
        written = writeFileAtomically(plots / (name + ".png"), *png);
        if (!written) return written;
    }
    return {};
}

}  // namespace fb
