// The policies, one file each; the table in select.cpp names them. To add one: a file, a line here, a row there, and
// its name in knobs/select.def.
#pragma once

#include "select/select.h"

namespace fb {

void selectLakhia(const SelectInput&, SelectState&, Selection&);
void selectLakhiaNaive(const SelectInput&, SelectState&, Selection&);
void selectCoarse(const SelectInput&, SelectState&, Selection&);
void selectFull(const SelectInput&, SelectState&, Selection&);

}  // namespace fb
