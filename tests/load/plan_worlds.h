// Small hierarchies that the tests of planning share.
#pragma once

#include "tiny_world.h"

namespace fb::test {

//            0
//       1         2       priorities 5 and 3
//     3   4     5   6     9 and 1, 2 and 2
inline World twoLevels() {
    return World(
        {{kRoot, 1, 100}, {0, 5, 100}, {0, 3, 100}, {1, 9, 100}, {1, 1, 100}, {2, 2, 100}, {2, 2, 100}});
}

// Four roots (0 to 3) of 100 bytes; root i has the children 4 + 2i and 5 + 2i of 100 bytes each. Priorities
// of the groups: 8, 4, 2, 1.
inline World fourGroups() {
    return World({{kRoot, 1, 100},
                  {kRoot, 1, 100},
                  {kRoot, 1, 100},
                  {kRoot, 1, 100},
                  {0, 8, 100},
                  {0, 8, 100},
                  {1, 4, 100},
                  {1, 1, 100},
                  {2, 2, 100},
                  {2, 1, 100},
                  {3, 1, 100},
                  {3, 1, 100}});
}

}  // namespace fb::test
