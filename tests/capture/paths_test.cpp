// SPDX-License-Identifier: MIT
#include "oiler/capture/file.hpp"

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

class Paths : public testing::Test {
protected:
    Paths() : former_(fs::current_path()) {
        put(folder_ / "in.toml", "scene");
        put(folder_ / "other", "");
        fs::create_directory(folder_ / "sub");
        fs::create_symlink("in.toml", folder_ / "soft");
        fs::create_symlink(".", folder_ / "here");
        fs::create_hard_link(folder_ / "in.toml", folder_ / "hard");
        fs::current_path(folder_.path());
    }
    ~Paths() override { fs::current_path(former_); }

    static std::string refusal(const std::vector<NamedPath>& inputs,
                               const std::vector<NamedPath>& outputs) {
        try {
            require_distinct(inputs, outputs);
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            return error.what();
        }
        return "";
    }

    Folder folder_;

private:
    fs::path former_;
};

TEST_F(Paths, AnOutputIsNoInputByWhateverName) {
    const std::vector<NamedPath> input{{"SCENE", "in.toml"}};
    for (const fs::path& same :
         {fs::path("in.toml"), fs::path("./in.toml"), fs::path("sub/../in.toml"),
          fs::path("here/in.toml"), folder_ / "in.toml", fs::path("soft"), fs::path("hard")})
        EXPECT_EQ(
            refusal(input, {{"--json", same}}),
            "--json: " + same.string() + " would overwrite SCENE, an input; give another path");
    for (const char* const another : {"other", "new", "sub/in.toml", "-", ""})
        EXPECT_EQ(refusal(input, {{"--json", another}}), "") << another;
}

TEST_F(Paths, TwoOutputsAreTwoFiles) {
    fs::create_symlink("other", folder_ / "link");
    using Pair = std::pair<fs::path, fs::path>;
    for (const auto& [a, b] :
         {Pair{"new", "./new"}, Pair{"new", folder_ / "new"}, Pair{"new/a", "sub/../new/a"},
          Pair{"sub/new", "here/sub/new"}, Pair{"link", "other"}, Pair{"-", "-"},
          Pair{"sub", "sub/"}, Pair{"new", "new/"}})
        EXPECT_EQ(refusal({}, {{"--trace", a}, {"--json", b}}),
                  "--trace and --json: both write " + b.string() + "; give two paths");
    for (const auto& [a, b] : {Pair{"new", "newer"}, Pair{"", ""}, Pair{"-", "new"},
                               Pair{"/dev/null", "/dev/null"}, Pair{"sub/new", "new"}})
        EXPECT_EQ(refusal({}, {{"--trace", a}, {"--json", b}}), "") << a << b;
}

TEST_F(Paths, ThePlaceOfStandardOutputCounts) {
    const int saved = dup(STDOUT_FILENO);
    std::fflush(stdout);
    FILE* const redirected = fopen("in.toml", "a");
    dup2(fileno(redirected), STDOUT_FILENO);
    const std::string input = refusal({{"SCENE", "in.toml"}}, {{"--json", "-"}});
    const std::string output = refusal({}, {{"--json", "-"}, {"--trace", "in.toml"}});
    dup2(saved, STDOUT_FILENO);
    close(saved);
    fclose(redirected);
    EXPECT_TRUE(holds(input, "SCENE"));
    EXPECT_TRUE(holds(output, "--trace"));
}

TEST_F(Paths, FilesOfAnOutputFolderCount) {
    const auto writes = [](std::string_view name) { return name == "in.toml" || name == "made"; };
    for (const fs::path& out :
         {fs::path("."), fs::path("here"), fs::path("here/"), folder_.path()}) {
        EXPECT_NE(refusal({{"PART", "in.toml"}}, {{"--out", out, writes}}), "") << out;
        EXPECT_NE(refusal({}, {{"--out", out, writes}, {"--json", "made"}}), "") << out;
        EXPECT_NE(refusal({}, {{"--json", "made"}, {"--out", out, writes}}), "") << out;
        EXPECT_EQ(refusal({}, {{"--out", out, writes}, {"--json", "other"}}), "") << out;
        EXPECT_EQ(refusal({}, {{"--out", out, writes}, {"--json", "sub/made"}}), "") << out;
    }
    EXPECT_NE(refusal({}, {{"--out", "new/", writes}, {"--json", "new/made"}}), "");
    EXPECT_NE(refusal({}, {{"--out", "new", writes}, {"--json", "here/new/made"}}), "");
    EXPECT_EQ(refusal({}, {{"--out", "new", writes}, {"--json", "newer/made"}}), "");
}

}  // namespace
}  // namespace oiler::test
