#include "measure/front_csv.h"

#include <gtest/gtest.h>

#include "worlds/tiny_walk.h"

namespace fb {
namespace {

//       0            1 is refused for lack of time, of 2 a child is missing
//     /   \          .
//    1     2
//   / \   / \        .
//  3   4 5   6
TEST(FrontCsv, SaysOfEachNodeWhyItIsNotFinerAndWhatThatWouldTake) {
    const TinyNode pair{.cost = 2, .children = {{.cost = 3, .benefit = 4}, {.cost = 3, .benefit = 4}}};
    TinyWalk walk({{.children = {pair, pair}}}, PolicyId::lakhiaNaive);
    walk.shareMs = 10.0;  // 5 each: 4 and 4 needed, then 6 of 5
    walk.loaded[5] = 0;
    for (NodeId n = 0; n < walk.hierarchy.size(); ++n) walk.hierarchy.residentBytes[n] = 100 + n;
    walk.step();
    EXPECT_EQ(frontCsv(walk.hierarchy, walk.selection.reached, walk.loaded, walk.view),
              "node,level,block,reason,need_ms,had_ms,missing_nodes,missing_bytes,err_px,triangles,texture_bytes\n"
              "1,1,0,time,6,5,0,0,141.4213562373095,4,0\n"
              "2,1,0,time,6,5,1,105,141.4213562373095,4,0\n");
    walk.shareMs = 14.0;
    walk.step();
    const std::string finer = frontCsv(walk.hierarchy, walk.selection.reached, walk.loaded, walk.view);
    EXPECT_NE(finer.find("\n2,1,0,load,6,7,1,105,"), std::string::npos) << finer;
    EXPECT_NE(finer.find("\n3,2,0,leaf,,,0,0,0,6,0\n"), std::string::npos) << finer;
    EXPECT_EQ(finer.find("\n1,"), std::string::npos) << finer;
}

}  // namespace
}  // namespace fb
