#include "load/bytes_per_cost.h"

#include <gtest/gtest.h>

#include "tiny_world.h"

namespace fb {
namespace {

//   0 (100 B, 10 textured)   1 (600 B, 10 untextured)   2 (7 B, empty: costs 1)
Hierarchy threeNodes() {
    const std::vector<test::NodeSpec> specs = {{kNoNode, 1, 100}, {kNoNode, 1, 600}, {kNoNode, 1, 7}};
    Hierarchy h = test::makeHierarchy(specs);
    h.texturedTriangles[0] = 10;
    h.untexturedTriangles[1] = 10;
    return h;
}

TEST(BytesPerCost, IsAllBytesOverAllCost) {
    // Costs with c_textured = 0.2: 2, 8, 1.
    EXPECT_DOUBLE_EQ(bytesPerCost(threeNodes(), 0.2).mean, 707.0 / 11.0);
    // With 0.5: 5, 5, 1.
    EXPECT_DOUBLE_EQ(bytesPerCost(threeNodes(), 0.5).mean, 707.0 / 11.0);
    // With 0.8: 8, 2, 1.
    Hierarchy h = threeNodes();
    h.untexturedTriangles[1] = 20;  // costs 4
    EXPECT_DOUBLE_EQ(bytesPerCost(h, 0.8).mean, 707.0 / 13.0);
}

TEST(BytesPerCost, SpreadIsThatOfTheNodes) {
    const BytesPerCost bytes = bytesPerCost(threeNodes(), 0.5);
    EXPECT_DOUBLE_EQ(bytes.p5, 7.0);     // node 2
    EXPECT_DOUBLE_EQ(bytes.p95, 120.0);  // node 1
}

TEST(BytesPerCost, OfANodeAloneHasNoSpread) {
    const std::vector<test::NodeSpec> specs = {{kNoNode, 1, 50}};
    const BytesPerCost bytes = bytesPerCost(test::makeHierarchy(specs), 0.5);
    EXPECT_EQ(bytes.mean, 50.0);
    EXPECT_EQ(bytes.p5, 50.0);
    EXPECT_EQ(bytes.p95, 50.0);
}

}  // namespace
}  // namespace fb
