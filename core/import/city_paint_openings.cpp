// Windows, shop fronts, doors and garages: reveal, frame, and behind the glass what its hash says.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

constexpr Colour kSky{176, 190, 202};
constexpr double kFrameMetres = 0.07, kBarMetres = 0.045;

// The inside of one opening on one row. y runs from 0 at the bottom of the inner rectangle.
struct Pane {
    const Facade& facade;
    const Opening& opening;
    const PaintRow& row;
    Run run;
    double left, width, y, height;

    [[nodiscard]] std::uint32_t part(int number) const { return latticeHash(opening.look, number, 1); }
    [[nodiscard]] float chance(int number) const { return unit(part(number)); }
    [[nodiscard]] Run at(double from, double to) const {
        return row.between(left + from, left + to).within(run);
    }
    // A bar across the row's way: at least a texel wide, weaker where it is narrower.
    void bar(double middle, double thickness, const Colour& colour) const {
        const double half = std::max(thickness, row.texel) / 2.0;
        row.blend(at(middle - half, middle + half), colour,
                  static_cast<float>(std::min(1.0, thickness / row.texel)));
    }
};

// What the pane mirrors: the sky above the roofs of the other side, with their uneven outline.
void paintGlass(const Pane& pane, const Run& run, const Colour& inside) {
    const float v = static_cast<float>(pane.y / pane.height);
    const float mirror = 0.12f + 0.55f * pane.chance(1) * pane.chance(2);
    const float outline = 0.1f + 0.9f * pane.chance(3);
    const Colour opposite{88.0f + 50.0f * pane.chance(4), 84.0f + 38.0f * pane.chance(4),
                          78.0f + 30.0f * pane.chance(5)};
    const Colour low = inside.mixed(opposite, mirror * 0.6f),
                 high = inside.mixed(kSky, mirror * (0.7f + 0.3f * v));
    // The lintel's shadow falls on the upper part.
    const float shadow = std::min(1.0f, 0.6f + 0.4f * static_cast<float>((pane.height - pane.y) / 0.3));
    for (int i = run.begin; i < run.end; ++i) {
        const float wave = pane.row.wave[i];
        const float sky = std::clamp((v + 0.22f * wave - outline) * 6.0f + 0.5f, 0.0f, 1.0f);
        pane.row.put(i, low.mixed(high, sky), shadow * (1.0f + 0.10f * wave));
    }
}

void paintWindowGlass(const Pane& pane) {
    const BuildingStyle& style = pane.facade.style;
    const bool lit = pane.chance(6) < 0.05f;
    const float dark = 0.6f + 0.8f * pane.chance(7);
    const Colour inside = lit ? Colour{150, 132, 98} : Colour{30.0f * dark, 34.0f * dark, 38.0f * dark};
    const float kind = pane.chance(8);
    const double v = pane.y / pane.height;
    if (kind < 0.42f && v > 1.0 - (0.12 + 0.88 * pane.chance(9))) {
        // A blind, drawn down part of the way; slats where texels are small enough.
        const bool slat = pane.row.texel < 0.035 && static_cast<int>(std::floor(pane.y / 0.06)) % 2 == 0;
        const float tone = (0.62f + 0.36f * pane.chance(10)) * (slat ? 0.86f : 1.0f);
        const float shadow = std::min(1.0f, 0.66f + 0.34f * static_cast<float>((pane.height - pane.y) / 0.3));
        for (int i = pane.run.begin; i < pane.run.end; ++i) {
            pane.row.put(i, style.blind, tone * shadow * (1.0f + 0.05f * pane.row.wave[i]));
        }
        return;
    }
    paintGlass(pane, pane.run, inside);
    if (kind > 0.62f) {
        // Curtains on both sides, their folds a wave of 0.12 m.
        const double open = 0.14 + 0.2 * pane.chance(11);
        const Colour cloth = Colour{196, 190, 178}.scaled(0.55f + 0.4f * pane.chance(12));
        for (const Run& side :
             {pane.at(0.0, open * pane.width), pane.at((1.0 - open) * pane.width, pane.width)}) {
            for (int i = side.begin; i < side.end; ++i) {
                const double s = pane.row.places[i] / 0.12;
                const double fold = std::abs(s - std::floor(s) - 0.5) * 2.0;
                pane.row.put(i, cloth, static_cast<float>(0.72 + 0.28 * fold));
            }
        }
    }
}

void paintFrame(const Pane& pane, int across, int down, const Colour& frame) {
    const double border = std::min(kFrameMetres, pane.width / 6.0);
    bool rail = pane.y < border || pane.height - pane.y < border;
    for (int k = 1; k < down; ++k) {
        const double at = pane.height * k / down;
        rail = rail || std::abs(pane.y - at) < std::max(kBarMetres, pane.row.texel * 0.7) / 2.0;
    }
    if (rail) {
        pane.row.blend(pane.run, frame, static_cast<float>(std::min(1.0, kFrameMetres / pane.row.texel)));
        return;
    }
    pane.bar(border / 2.0, border, frame.scaled(0.92f));
    pane.bar(pane.width - border / 2.0, border, frame);
    for (int k = 1; k < across; ++k) pane.bar(pane.width * k / across, kBarMetres, frame);
}

void paintShop(const Pane& whole) {
    constexpr double kRiser = 0.4;  // the wall under the shop window
    if (whole.y < kRiser) {
        whole.row.fill(whole.run, whole.facade.style.door.scaled(whole.y > kRiser - 0.06 ? 0.9f : 0.6f));
        return;
    }
    const Pane pane{whole.facade, whole.opening, whole.row,        whole.run,
                    whole.left,   whole.width,   whole.y - kRiser, whole.height - kRiser};
    const float bright = 0.35f + 0.5f * pane.chance(6);
    paintGlass(pane, pane.run, Colour{70, 64, 56}.scaled(bright));
    // Goods on shelves, dim behind the glass; the upper third is empty.
    const double shelf = 0.36 + 0.2 * pane.chance(13);
    const auto level = static_cast<int>(std::floor(pane.y / shelf));
    const double onShelf = pane.y / shelf - level;
    if (pane.y < pane.height * 0.62) {
        const double pitch = 0.16 + 0.2 * pane.chance(22);
        const auto boxes = static_cast<int>(pane.width / pitch);
        const Colour mood = Colour{150, 132, 108}.mixed(pane.facade.style.accent, 0.5f * pane.chance(23));
        for (int k = 0; k < boxes; ++k) {
            const std::uint32_t hash = latticeHash(pane.opening.look, k, level + 64);
            if (unit(hash) < 0.25f || onShelf > 0.35 + 0.5 * unit(mixBits(hash))) continue;
            const Colour goods{70.0f + static_cast<float>(hash & 127),
                               66.0f + static_cast<float>((hash >> 7) & 127),
                               62.0f + static_cast<float>((hash >> 14) & 127)};
            const double from = pitch * (k + 0.1);
            pane.row.blend(pane.at(from, from + pitch * (0.5 + 0.4 * unit(hash ^ 77u))),
                           goods.mixed(mood, 0.6f), 0.34f);
        }
        if (onShelf > 0.92) pane.row.blend(pane.run, {30, 28, 26}, 0.3f);
    }
    if (pane.height - pane.y < 0.25 && pane.chance(14) < 0.6f) {
        pane.row.blend(pane.run, {236, 226, 190}, 0.45f);  // lamps under the ceiling
    }
    if (pane.chance(15) < 0.4f && pane.width > 1.4) {
        // A poster on the glass.
        const double from = 0.2 + (pane.width - 1.2) * pane.chance(16), low = 0.5 + 0.3 * pane.chance(17);
        if (pane.y > low && pane.y < low + 1.0) {
            const Colour paper = pane.facade.style.accent.mixed({240, 236, 220}, pane.chance(18));
            pane.row.fillPlain(pane.at(from, from + 0.7), paper);
            paintText(pane.row, signText(pane.part(19)), pane.left + from + 0.08,
                      pane.row.at - pane.y + low + 0.85, 0.022, {40, 36, 34}, 0.9f);
        }
    }
    const int across = std::max(1, static_cast<int>(pane.width / 1.5));
    paintFrame(pane, across, pane.chance(20) < 0.5f ? 1 : 3, pane.facade.style.frame);
}

void paintDoor(const Pane& pane) {
    constexpr double kLeafMetres = 2.12;
    const BuildingStyle& style = pane.facade.style;
    const bool shopDoor = pane.opening.at.y1 > 26;
    const double leafTop = std::min(kLeafMetres, pane.height);
    if (pane.y >= leafTop) {  // the light above the door
        const Pane above{pane.facade, pane.opening, pane.row,         pane.run,
                         pane.left,   pane.width,   pane.y - leafTop, pane.height - leafTop};
        paintGlass(above, above.run, {40, 42, 44});
        paintFrame(above, 1, 1, style.frame);
        return;
    }
    const Pane leaf{pane.facade, pane.opening, pane.row, pane.run, pane.left, pane.width, pane.y, leafTop};
    const bool glazed = shopDoor && pane.chance(21) < 0.7f;
    if (glazed && leaf.y > 0.3) {
        paintGlass(leaf, leaf.run, {44, 44, 44});
        paintFrame(leaf, leaf.width > 1.5 ? 2 : 1, 1, style.door.scaled(0.8f));
    } else {
        pane.row.fill(leaf.run, style.door);
        // Sunk panels: two columns, three rows.
        const double h = leaf.y / leafTop * 3.0;
        const double inRow = (h - std::floor(h)) * leafTop / 3.0;
        if (inRow > 0.1 && inRow < leafTop / 3.0 - 0.06) {
            for (const double side : {0.0, 0.5}) {
                const double from = leaf.width * side + 0.1, to = leaf.width * (side + 0.5) - 0.08;
                const bool edge = inRow < 0.14 || inRow > leafTop / 3.0 - 0.1;
                pane.row.fill(leaf.at(from, to), style.door.scaled(edge ? 0.62f : 0.86f));
            }
        }
    }
    if (leaf.y > 0.98 && leaf.y < 1.1) pane.row.fillPlain(leaf.at(0.08, 0.16), {168, 160, 140});
}

void paintGarage(const Pane& pane) {
    const double slat = pane.y / 0.12;
    const float tone = slat - std::floor(slat) < 0.25 && pane.row.texel < 0.06 ? 0.72f : 1.0f;
    pane.row.fill(pane.run, Colour{138, 140, 142}.mixed(pane.facade.style.door, 0.3f).scaled(tone));
}

}  // namespace

void paintOpening(const Facade& facade, const Opening& opening, const OpeningRuns& runs,
                  const PaintRow& row) {
    const double low = opening.at.y0 / 10.0 + kHalfStep, high = opening.at.y1 / 10.0 - kHalfStep;
    const Colour surround = opening.painted ? facade.style.trim : facade.style.wallColour;
    const Run &outer = runs.outer, &inner = runs.inner;
    if (row.at > high) {  // the soffit
        row.fill(outer, surround.scaled(0.5f));
        return;
    }
    if (row.at < low) {  // the sill; a threshold under doors
        row.fill(outer, facade.style.trim.scaled(opening.kind == OpeningKind::window ? 1.0f : 0.6f));
        return;
    }
    row.fill({outer.begin, inner.begin}, surround.scaled(0.62f));
    row.fill({inner.end, outer.end}, surround.scaled(0.85f));
    const double start = facade.starts[opening.segment];
    const double left = start + opening.at.s0 / 10.0 + kHalfStep,
                 right = start + opening.at.s1 / 10.0 - kHalfStep;
    const Pane pane{facade, opening, row, inner, left, right - left, row.at - low, high - low};
    switch (opening.kind) {
        case OpeningKind::window:
            paintWindowGlass(pane);
            paintFrame(pane, facade.style.panesAcross, facade.style.panesDown, facade.style.frame);
            break;
        case OpeningKind::shop:
            paintShop(pane);
            break;
        case OpeningKind::door:
            paintDoor(pane);
            break;
        case OpeningKind::garage:
            paintGarage(pane);
            break;
    }
}

}  // namespace fb::city
