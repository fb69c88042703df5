// SPDX-License-Identifier: MIT
#include "house/scan.hpp"
#include "support/test.hpp"

namespace oiler::house {
namespace {

using Names = std::vector<std::string>;

/// The definitions of a text in namespace n, without "n::".
Names names_in_namespace(const std::string& text) {
    Names names;
    const Definitions found = find_definitions("namespace n {\n" + text + "\n}  // namespace n\n");
    EXPECT_TRUE(found.balanced) << text;
    for (const std::string& name : found.names) {
        EXPECT_TRUE(name.starts_with("n::")) << name;
        names.push_back(name.substr(3));
    }
    return names;
}

TEST(HouseScan, FindsTypes) {
    EXPECT_EQ(names_in_namespace("struct A { int a; struct B {}; };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("class A final : public B<int> { A(); };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("union A { int a; };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("enum class A : std::uint8_t { a, b };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("struct [[nodiscard]] alignas(64) A {};"), Names{"A"});
    EXPECT_EQ(names_in_namespace("template <class T, int N = (1 > 0)> struct A {};"), Names{"A"});
    EXPECT_EQ(names_in_namespace("template <class T> using A = std::vector<T>;"), Names{"A"});
    EXPECT_EQ(
        names_in_namespace("template <class T> concept A = requires(T t) { t.x(); } && B<T>;"),
        Names{"A"});
}

TEST(HouseScan, FindsVariables) {
    EXPECT_EQ(names_in_namespace("inline constexpr std::array a{1, 2};"), Names{"a"});
    EXPECT_EQ(names_in_namespace("constexpr double a = f(3) < 2;"), Names{"a"});
    EXPECT_EQ(names_in_namespace("const std::map<int, B<int>> a = [] { return f(); }();"),
              Names{"a"});
    EXPECT_EQ(names_in_namespace("const int a[] = {1, 2};"), Names{"a"});
    EXPECT_EQ(names_in_namespace("template <class T> constexpr T a = T(3);"), Names{"a"});
}

TEST(HouseScan, FindsSignaturesOfFunctions) {
    EXPECT_EQ(names_in_namespace("int f(const A& a, unsigned b = 2) { return g({1}); }"),
              Names{"f(const A&,unsigned)"});
    EXPECT_EQ(names_in_namespace("std::function<void(int)> f() { return {}; } int g() {}"),
              (Names{"f()", "g()"}));
    EXPECT_EQ(names_in_namespace("A::A(int a) : a_{a}, b_(a) {} void A::f() const {}"),
              Names{"A::f() const"});
    EXPECT_EQ(names_in_namespace("bool operator==(A a, A b) { return true; }"),
              Names{"operator==(A,A)"});
    EXPECT_EQ(names_in_namespace("template <class T> [[nodiscard]] auto f(T t) -> int { }"),
              Names{"template<class T> f(T)"});
    EXPECT_EQ(names_in_namespace("template <B T> auto f(T t) { return [](int a) { }; }"),
              Names{"template<B T> f(T)"});
}

TEST(HouseScan, IgnoresDeclarationsMembersAndSpecialisations) {
    for (const char* text :
         {"struct A;", "enum class A : int;", "class A; template <class T> struct B;",
          "template <> struct A<int> { int a; };", "template <class T> struct A<T*> {};",
          "template <> constexpr bool a<int> = true;", "template <> void f<int>(int) {}",
          "template const A<int>& f();", "extern int a;", "int f(const A& a, int b = 2);",
          "using std::swap;", "using namespace b;", "namespace a = b::c;", "static_assert(true);",
          "namespace { struct A {}; int a = 1; void f() {} }", "struct A::B { int a; };",
          "namespace a { namespace { struct A {}; } }", "template <class T> void A<T>::f() {}"})
        EXPECT_EQ(names_in_namespace(text), Names{}) << text;
}

TEST(HouseScan, ReadsNeitherCommentsNorLiteralsNorPreprocessorLines) {
    EXPECT_EQ(names_in_namespace("// struct A {};\n/* struct B {\n */ struct C {};"), Names{"C"});
    EXPECT_EQ(names_in_namespace("#define A \\\n struct B {\nstruct C {};"), Names{"C"});
    EXPECT_EQ(names_in_namespace("auto a = \"} // \\\" {\"; struct B {};"), (Names{"a", "B"}));
    EXPECT_EQ(names_in_namespace("auto a = R\"x(}\" )\" struct C {)x\"; struct B {};"),
              (Names{"a", "B"}));
    EXPECT_EQ(names_in_namespace("char a = '{'; int b = 1'000'000; char c = '\\'';"),
              (Names{"a", "b", "c"}));
}

TEST(HouseScan, NamesTheNamespace) {
    EXPECT_EQ(find_definitions("namespace a::b { struct A {}; } struct A {};").names,
              (Names{"a::b::A", "A"}));
    EXPECT_EQ(find_definitions("namespace a { extern \"C\" { struct A {}; } struct B {}; }").names,
              (Names{"a::A", "a::B"}));
    EXPECT_EQ(find_definitions("namespace a { inline namespace b { struct A {}; } }").names,
              Names{"a::b::A"});
}

TEST(HouseScan, FindsUnmatchedBrackets) {
    for (const char* text : {"namespace a {", "}", "void f() { {", "int a = (1;"})
        EXPECT_FALSE(find_definitions(text).balanced) << text;
}

TEST(HouseScan, FindsIncludesOutsideComments) {
    EXPECT_EQ(find_includes("#include <a>\n  #  include \"b/c.hpp\"\n"), (Names{"a", "b/c.hpp"}));
    EXPECT_EQ(find_includes("// #include <a>\n/*\n#include <b>\n*/\n"), Names{});
}

}  // namespace
}  // namespace oiler::house
