// What stands out of the wall: ledges, cornices, pilasters, bay windows, sills; signs, balconies and awnings
// over it.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

void paintCornice(const BuildingStyle& style, const Relief& relief, const Run& run, const PaintRow& row,
                  float v) {
    const float tone = v > 0.85f ? 1.1f : v < 0.12f ? 0.7f : 1.0f;
    row.fill(run, style.trim.scaled(tone));
    // Dentils under the projecting part.
    const bool lower = relief.depthLow < style.corniceDepth * 0.9;
    if (!style.dentils || !lower || row.texel > 0.09 || v > 0.8f) return;
    for (int i = run.begin; i < run.end; ++i) {
        if (phase(row.places[i], 0.26) < 0.45) row.put(i, style.trim, 0.58f * row.shade[i]);
    }
}

void paintPilaster(const BuildingStyle& style, const Run& run, const PaintRow& row, const Relief& relief,
                   double start) {
    row.fill(run, style.trim.scaled(0.95f));
    const double left = start + relief.at.s0 / 10.0, right = start + relief.at.s1 / 10.0;
    row.fill(row.between(left - kHalfStep, left + kHalfStep).within(run), style.trim.scaled(0.72f));
    row.fill(row.between(right - kHalfStep, right + kHalfStep).within(run), style.trim.scaled(0.6f));
}

void paintBayWindow(const BuildingStyle& style, const Relief& relief, const Run& run, const PaintRow& row,
                    double start) {
    const double board = phase(row.at, 0.9);
    row.fill(run, style.trim.scaled(board < 0.05 ? 0.78f : 0.97f));
    const double left = start + relief.at.s0 / 10.0, right = start + relief.at.s1 / 10.0;
    row.fill(row.between(left - kHalfStep, left + kHalfStep).within(run), style.trim.scaled(0.8f));
    row.fill(row.between(right - kHalfStep, right + kHalfStep).within(run), style.trim.scaled(0.66f));
}

void paintSign(const Facade& facade, const Relief& relief, const Run& run, const PaintRow& row) {
    const double low = relief.at.y0 / 10.0, high = relief.at.y1 / 10.0;
    const double start = facade.starts[relief.segment] + relief.at.s0 / 10.0;
    const double width = (relief.at.s1 - relief.at.s0) / 10.0;
    const std::uint32_t hash = mixBits(relief.look);
    const bool lightBoard = (hash & 3u) == 0;
    const Colour board = lightBoard ? Colour{222, 214, 196} : facade.style.accent;
    const Colour ink = lightBoard ? facade.style.accent.scaled(0.8f) : Colour{236, 228, 206};
    const bool border = row.at > high - 0.05 || row.at < low + 0.05;
    row.fill(run, border ? board.mixed(ink, 0.35f) : board);
    const std::string_view text = signText(hash >> 3);
    const double cell = std::min(0.064, width * 0.85 / textWidth(text, 1.0));
    const double top = (low + high) / 2.0 + 2.5 * cell;
    paintText(row, text, start + (width - textWidth(text, cell)) / 2.0, top, cell, ink, 0.95f);
}

void paintBalcony(const BuildingStyle& style, const Run& run, const PaintRow& row, float v) {
    if (v < 0.16f || v > 0.93f) {  // slab and handrail
        row.fill(run, style.trim.scaled(v < 0.16f ? 0.86f : 1.04f));
        return;
    }
    const bool fine = row.texel < 0.06;
    for (int i = run.begin; i < run.end; ++i) {
        const bool post = fine && phase(row.places[i], 0.16) < 0.4;
        row.put(i, post ? style.trim : style.trim.scaled(fine ? 0.5f : 0.66f), row.shade[i]);
    }
}

void paintAwning(const BuildingStyle& style, const Relief& relief, const Run& run, const PaintRow& row,
                 float v) {
    if (row.at < relief.at.y0 / 10.0 + kHalfStep) {  // the underside
        row.fill(run, style.accent.scaled(0.28f));
        return;
    }
    const bool striped = (relief.look & 1u) != 0;
    const float tone = v < 0.2f ? 0.72f : 0.9f + 0.2f * v;  // the valance hangs in the shade
    for (int i = run.begin; i < run.end; ++i) {
        const bool light = striped && phase(row.places[i], 0.5) < 0.5;
        row.put(i, light ? Colour{226, 220, 206} : style.accent,
                tone * (0.96f + 0.06f * row.wave[i]) * row.shade[i]);
    }
}

}  // namespace

void paintRelief(const Facade& facade, const Relief& relief, const Run& run, const PaintRow& row) {
    const BuildingStyle& style = facade.style;
    const double low = relief.at.y0 / 10.0 - kHalfStep, high = relief.at.y1 / 10.0 + kHalfStep;
    const bool overhangs = relief.kind >= ReliefKind::balcony || relief.kind == ReliefKind::bayWindow;
    if (overhangs && row.at <= low && row.at > low - 0.7) {
        row.darken(run, static_cast<float>(0.55 + 0.45 * (low - row.at) / 0.7));
        return;
    }
    if (row.at <= low || row.at >= high) return;
    const auto v = static_cast<float>((row.at - low) / (high - low));
    const double start = relief.segment == kAllRound ? 0.0 : facade.starts[relief.segment];
    switch (relief.kind) {
        case ReliefKind::plinth:
            row.fill(run, style.trim.scaled(0.68f));
            break;
        case ReliefKind::pilaster:
            paintPilaster(style, run, row, relief, start);
            break;
        case ReliefKind::ledge:
            row.fill(run, style.trim.scaled(v > 0.75f ? 1.08f : v < 0.2f ? 0.75f : 0.98f));
            break;
        case ReliefKind::cornice:
            paintCornice(style, relief, run, row, v);
            break;
        case ReliefKind::bayWindow:
            paintBayWindow(style, relief, run, row, start);
            break;
        case ReliefKind::sill:
            row.fill(run, style.trim);
            break;
        case ReliefKind::sign:
            paintSign(facade, relief, run, row);
            break;
        case ReliefKind::balcony:
            paintBalcony(style, run, row, v);
            break;
        case ReliefKind::awning:
            paintAwning(style, relief, run, row, v);
            break;
    }
}

}  // namespace fb::city
