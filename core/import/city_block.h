// Makes one unit of the procedural city: the mesh and the textures of a SourceBlock.
#pragma once

#include <string>

#include "import/city_budget.h"

namespace fb::city {

[[nodiscard]] SourceBlock makeBlock(const CityPlan& plan, const Unit& unit, const UnitBudget& budget,
                                    const std::string& name);

}  // namespace fb::city
