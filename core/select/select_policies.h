// The policies, one file each; the table in select.cpp names them. To add one: a file, a line here, a row there, and
// its name in knobs/select.def.
#pragma once

#include "select/select.h"

namespace fb {

void selectLakhia(const SelectInput&, SelectState&, Selection&);
void selectLakhiaNaive(const SelectInput&, SelectState&, Selection&);
void selectFunkhouser(const SelectInput&, SelectState&, Selection&);
void selectFunkhouserIncremental(const SelectInput&, SelectState&, Selection&);
void selectMacielShirley(const SelectInput&, SelectState&, Selection&);
void selectErikson(const SelectInput&, SelectState&, Selection&);
void selectGreedy(const SelectInput&, SelectState&, Selection&);
void selectScreenError(const SelectInput&, SelectState&, Selection&);
void selectCoarse(const SelectInput&, SelectState&, Selection&);
void selectFull(const SelectInput&, SelectState&, Selection&);
void selectFrontbench(const SelectInput&, SelectState&, Selection&);

}  // namespace fb
