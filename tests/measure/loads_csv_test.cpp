#include "measure/loads_csv.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

TEST(LoadsCsv, HasARowForEachLoadAndEmptyFieldsForWhatDidNotCome) {
    Hierarchy h;
    h.resize(8);
    h.level[7] = 2;
    LoadRecord done{.node = 7, .suspensions = 3, .bytes = 640, .queuedAt = 10.5, .firstReadAt = 11, .readAt = 12};
    done.decodedAt = 13;
    done.uploadedAt = 14;
    done.firstDrawnAt = 15.25;
    done.missedAt = 10.25;
    done.endedAt = 16;
    done.end = LoadEnd::evicted;
    const LoadRecord waiting{.node = 3, .bytes = 64, .queuedAt = 12};
    LoadRecord withdrawn = waiting, broken = waiting;
    withdrawn.end = LoadEnd::cancelled;
    withdrawn.endedAt = 12.5;
    broken.end = LoadEnd::failed;
    broken.endedAt = 13;
    const LoadRecord loads[] = {done, waiting, withdrawn, broken};
    EXPECT_EQ(loadsCsv(h, loads, 10.0),
              "node,level,bytes,missed_s,queued_s,first_read_s,read_s,decoded_s,uploaded_s,first_drawn_s,suspended,end,ended_s\n"
              "7,2,640,0.25,0.5,1,2,3,4,5.25,3,evicted,6\n"
              "3,0,64,,2,,,,,,0,,\n"
              "3,0,64,,2,,,,,,0,cancelled,2.5\n"
              "3,0,64,,2,,,,,,0,failed,3\n");
}

}  // namespace
}  // namespace fb
