// A machine without any OpenCL driver: the ICD loader is pointed at an empty folder before its
// first use, so this is a program of its own.
#include "host/cl/device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdlib.h>

namespace {

using namespace macula::compute;

const int kHidden = setenv("OCL_ICD_VENDORS", "/nonexistent", 1);

TEST(NoPlatform, ListsAreEmptyAndNothingThrows) {
    ASSERT_EQ(kHidden, 0);
    EXPECT_TRUE(platforms().empty());
    EXPECT_TRUE(enumerate().empty());
}

TEST(NoPlatform, OpeningNamesThePackageThatBringsACpuDevice) {
    for (const char* selector : {"", "0", "cpu", "nosuch"})
        EXPECT_THAT([&] { open(selector); },
                    testing::ThrowsMessage<Error>(testing::HasSubstr("pocl-opencl-icd")));
}

} // namespace
