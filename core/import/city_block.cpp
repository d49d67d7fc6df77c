#include "import/city_block.h"

#include <algorithm>
#include <memory>

#include "base/check.h"
#include "import/city_paint.h"

namespace fb::city {
namespace {

constexpr glm::vec4 kUnphotographed{0.56f, 0.56f, 0.56f, 1.0f};

std::uint32_t addPicture(SourceBlock& block, const std::string& name, Image&& image) {
    block.textures.push_back({name, {}, {}, std::make_shared<const Image>(std::move(image))});
    block.materials.push_back({name, glm::vec4(1.0f), static_cast<int>(block.textures.size()) - 1, false});
    return static_cast<std::uint32_t>(block.materials.size() - 1);
}

// Cars and lamps stand where the ground under them is lowest, machinery on its roof.
double standsAt(const CityPlan& plan, const Unit& unit, const Thing& thing) {
    const Lump& lump = thing.front();
    for (const Building& b : unit.buildings) {
        if (lump.base.y > 1.0 && b.footprint.contains(lump.base.x, lump.base.z)) return b.baseY;
    }
    const double x = lump.size.x / 2.0, z = lump.size.z / 2.0;
    return plan.hills.within(lump.base.x - x, lump.base.z - z, lump.base.x + x, lump.base.z + z).low;
}

// Where the ground goes on in the next unit.
void markBorder(const Rect& region, SourceMesh& mesh) {
    mesh.shared.reserve(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) {
        const bool isOnBorder = p.x == region.x0 || p.x == region.x1 || p.z == region.z0 || p.z == region.z1;
        mesh.shared.push_back(isOnBorder ? 1 : 0);
    }
}

}  // namespace

SourceBlock makeBlock(const CityPlan& plan, const Unit& unit, const UnitBudget& budget,
                      const std::string& name) {
    const UnitDesign design = designUnit(plan, unit);
    const std::span<const Thing> things(design.things.data(), budget.things);
    SourceBlock block;
    block.name = name;
    block.materials.push_back({"without photographs", kUnphotographed, -1, false});
    constexpr std::uint32_t kGrey = 0;

    MeshBuilder mesh;
    mesh.reserve(budget.triangles);
    std::size_t raised = 0;  // vertices that stand where they belong
    const auto raiseBy = [&](double metres) {
        if (plan.hills.exist) mesh.raise(raised, [metres](double, double) { return metres; });
        raised = mesh.vertexCount();
    };
    for (std::size_t i = 0; i < design.facades.size(); ++i) {
        const Facade& facade = design.facades[i];
        const Detail detail = detailOf(facade, budget);
        const FacadeGrid features = featureGrid(facade, detail);
        std::uint32_t material = kGrey;
        if (!budget.grey[i]) {
            const PictureSize size = facadePictureSize(facade, features, budget.texelsPerMetre);
            material =
                addPicture(block, "facade " + std::to_string(i + 1), paintFacade(facade, features, size));
        }
        const FacadeGrid grid =
            fillGrid(features, budget.spacing * spacingFactor(facade.role), facade.seed + 9);
        addFacade(facade, grid, detail, material, !budget.grey[i], mesh);
        raiseBy(facade.baseY);
    }
    const PictureSize size = aerialPictureSize(unit, budget.texelsPerMetre);
    const std::uint32_t aerial = addPicture(block, "from above", paintAerial(plan, unit, things, size));
    addGround(plan, unit, design.ground, budget.spacing * kGroundSpacingFactor, aerial, mesh);
    if (plan.hills.exist) {
        mesh.raise(raised, [&](double x, double z) { return plan.hills.heightAt(x, z); });
        raised = mesh.vertexCount();
    }
    for (const Building& building : unit.buildings) {
        addRoof(unit, building, budget.spacing * kRoofSpacingFactor, aerial, mesh);
        raiseBy(building.baseY);
    }
    for (const Thing& thing : things) {
        addThing(thing, budget.thingSpacing, kGrey, mesh);
        raiseBy(plan.hills.exist ? standsAt(plan, unit, thing) : 0.0);
    }
    FB_CHECK(mesh.triangleCount() == budget.triangles);
    if (plan.hills.exist) addFoundations(plan, unit, kGrey, mesh);
    block.mesh = mesh.finish();
    markBorder(unit.region, block.mesh);
    return block;
}

}  // namespace fb::city
