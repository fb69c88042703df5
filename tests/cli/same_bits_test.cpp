// SPDX-License-Identifier: MIT
// Plays every scene in assets/scenes with several numbers of threads and instruction sets.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const std::filesystem::path scenes = std::filesystem::path(OILER_SOURCE) / "assets/scenes";

/// Empty if the machine lacks the instructions.
std::string hash_of(const std::filesystem::path& scene, const std::string& environment,
                    const std::string& options) {
    const Outcome run = shell(environment + " oiler play " + scene.string() +
                              " --steps 100 --quiet --json - " + options);
    if (run.exit == 2 && run.err.find("which this build and machine have") != std::string::npos)
        return {};
    EXPECT_EQ(run.exit, 0) << run.err;
    return nlohmann::json::parse(run.out).at("state_hash");
}

TEST(SameBits, InEveryScene) {
    int played = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        if (entry.path().extension() != ".toml") continue;
        const std::string alone = hash_of(entry, "OILER_INSTRUCTIONS=baseline", "");
        ASSERT_EQ(alone.size(), 16U) << entry.path();
        for (const char* set : {"avx2", "avx512"}) {
            const std::string hash =
                hash_of(entry, std::string("OILER_INSTRUCTIONS=") + set, "--threads 2");
            EXPECT_TRUE(hash.empty() || hash == alone) << entry.path() << " with " << set;
        }
        for (const char* threads : {"1", "2", "3", "8"})
            EXPECT_EQ(hash_of(entry, "", std::string("--threads ") + threads), alone)
                << entry.path() << ", " << threads << " threads";
        ++played;
    }
    EXPECT_GE(played, 10);
}

TEST(SameBits, RefusesAnUnknownInstructionSet) {
    const Outcome run = shell(
        "OILER_INSTRUCTIONS=mmx oiler play " + (scenes / "orbit.toml").string() + " --steps 1", 2);
    EXPECT_TRUE(holds(run.err, "OILER_INSTRUCTIONS=mmx: expected one of baseline"));
}

}  // namespace
}  // namespace oiler::test
