// SPDX-License-Identifier: MIT
#include "oiler/app/trace_writer.hpp"

#include <charconv>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The files of a trace writer after tick 0 and `steps` steps.
struct Recorded {
    Recorded(World& world, int steps) {
        const Folder folder;
        TraceWriter writer(folder / "trace", folder / "energy", world);
        for (int i = 0; i < steps; ++i) {
            world.step();
            writer.write(i + 1, world);
        }
        writer.commit();
        trace = text_of(folder / "trace");
        energy = text_of(folder / "energy");
    }
    std::string trace;
    std::string energy;
};

/// The number in column `column` of the last row.
template <class T>
T last_number(const std::string& csv, std::size_t column) {
    std::istringstream rows(csv);
    std::string row;
    for (std::string next; std::getline(rows, next);) row = next;
    std::istringstream fields(row);
    std::string field;
    for (std::size_t i = 0; i <= column; ++i) std::getline(fields, field, ',');
    T number = 0;
    std::from_chars(field.data(), field.data() + field.size(), number);
    return number;
}

// With the digits of a double, 0.1F would be 0.10000000149011612.
TEST(TraceWriter, TracesFloatsInTheirShortestForm) {
    World world(3, {.precision = Precision::single});
    world.spawn(Body{.position = {0.1, -0.2, 0.3}, .velocity = {1e-7, 2.5, 0.7}});
    EXPECT_EQ(Recorded(world, 0).trace,
              "tick,time,body,x,y,z,vx,vy,vz\n"
              "0,0,0,0.1,-0.2,0.3,1e-07,2.5,0.7\n");
}

// 0.1 + 0.2 needs 17 digits.
TEST(TraceWriter, TracesDoublesInTheirShortestForm) {
    World world(1);
    world.spawn(Body{.position = {0.1 + 0.2}, .velocity = {0.1}});
    EXPECT_EQ(Recorded(world, 0).trace, "tick,time,body,x,vx\n0,0,0,0.30000000000000004,0.1\n");
}

template <class T>
void expect_same_bits(Precision precision) {
    World world(2, {.rate = {3}, .precision = precision});
    const Entity entity = world.spawn(Body{.position = {0.1, 0.7}, .velocity = {1.1, -1e-3}},
                                      Spring{.stiffness = 0.3, .damping = 0.01});
    const std::string trace = Recorded(world, 7).trace;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_EQ(last_number<T>(trace, 3 + axis), world.position(entity).axis[axis]);
        EXPECT_EQ(last_number<T>(trace, 5 + axis), world.velocity(entity).axis[axis]);
    }
}

TEST(TraceWriter, TracesNumbersThatReadBackToTheSameBits) {
    expect_same_bits<float>(Precision::single);
    expect_same_bits<double>(Precision::double_);
}

// At 4 steps per second a free body at 2 m/s moves 0.5 m per step. The body of entity 2 is in row
// 0.
TEST(TraceWriter, TracesEachBodyByItsEntityAfterEachStep) {
    World world(1, {.rate = {4}});
    const Entity gone = world.spawn(Body{});
    world.spawn(Body{.position = {1}, .velocity = {2}});
    world.spawn(Body{.position = {8}});
    world.destroy(gone);
    EXPECT_EQ(Recorded(world, 2).trace,
              "tick,time,body,x,vx\n"
              "0,0,2,8,0\n0,0,1,1,2\n"
              "1,0.25,2,8,0\n1,0.25,1,1.5,2\n"
              "2,0.5,2,8,0\n2,0.5,1,2,2\n");
}

// At the start ½·2·3² = 9 J and 2·10·5 = 100 J. A step of 0.5 s of semi-implicit Euler changes the
// velocity by −10·0.5 m/s to −2 m/s and the height by −1 m: 4 J and 80 J.
TEST(TraceWriter, WritesEachEnergyInItsColumn) {
    World world(2, {.rate = {2}});
    world.set_gravity({0, -10});
    world.spawn(Body{.mass = 2, .position = {0, 5}, .velocity = {0, 3}});
    EXPECT_EQ(Recorded(world, 1).energy,
              "tick,time,kinetic,potential,total\n0,0,9,100,109\n1,0.5,4,80,84\n");
}

TEST(TraceWriter, IsActiveForEitherFile) {
    const Folder folder;
    const World world(1);
    EXPECT_FALSE(TraceWriter({}, {}, world).active());
    EXPECT_TRUE(TraceWriter(folder / "trace", {}, world).active());
    EXPECT_TRUE(TraceWriter({}, folder / "energy", world).active());
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>())
        << "without commit() there are no files";
}

}  // namespace
}  // namespace oiler::test
