// SPDX-License-Identifier: MIT
#include "oiler/core/handle_slots.hpp"

#include "support/test.hpp"

namespace {

struct Handle {
    std::uint32_t slot;
    std::uint32_t generation;
};

TEST(HandleSlots, KnowWhatIsGone) {
    oiler::HandleSlots slots;
    const auto first = slots.take<Handle>();
    const auto second = slots.take<Handle>();
    EXPECT_NE(first.slot, second.slot);
    slots.release(first.slot);
    EXPECT_FALSE(slots.holds(first.slot, first.generation));
    EXPECT_TRUE(slots.holds(second.slot, second.generation));
    EXPECT_EQ(slots.used(), 1U);
    const auto third = slots.take<Handle>();
    EXPECT_EQ(third.slot, first.slot);
    EXPECT_TRUE(slots.holds(third.slot, third.generation));
    EXPECT_FALSE(slots.holds(first.slot, first.generation));
    EXPECT_FALSE(slots.holds(7, 1));
}

// While a slot is free, no handle matches, not even one that a copy gave out.
TEST(HandleSlots, OfACopyGiveHandlesOfTheirOwn) {
    oiler::HandleSlots slots;
    const auto first = slots.take<Handle>();
    oiler::HandleSlots copy = slots;
    slots.release(first.slot);
    EXPECT_TRUE(copy.holds(first.slot, first.generation));
    EXPECT_FALSE(slots.holds(first.slot, slots.generation(first.slot) - 1));
    EXPECT_EQ(slots.generation(first.slot) % 2, 0U);
}

}  // namespace
