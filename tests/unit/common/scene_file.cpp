#include "common/scene_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include <filesystem>
#include <fstream>

#include "common/errors.hpp"
#include "common/shared_sections.hpp"

using namespace common;

namespace {

std::string message_of(const SceneFile& scene) {
    try {
        scene.finish();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::size_t line_count(const std::string& text) {
    return text.empty() ? 0 : 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST(SceneFile, ReadsTypedKeysAndFillsInDefaults) {
    const auto scene = SceneFile::parse("[waves]\nheight = 0.2\nkind = 'solitary'\n", "a.toml");
    const auto waves = scene.section("waves");
    EXPECT_EQ(waves.number("height", "m", "wave height", Range::positive()), 0.2);
    EXPECT_EQ(waves.number("period", "s", "wave period", Range::positive(), 1.65), 1.65);
    EXPECT_EQ(waves.choice("kind", "kind of waves", {"regular", "solitary"}, "regular"), "solitary");
    EXPECT_NO_THROW(scene.finish());
    const auto values = scene.values();
    ASSERT_EQ(values.size(), 3u);
    EXPECT_FALSE(values[0].is_default);
    EXPECT_TRUE(values[1].is_default);
    EXPECT_EQ(values[1].unit, "s");
}

TEST(SceneFile, AcceptsWholeNumbersWhereRealOnesAreExpected) {
    const auto scene = SceneFile::parse("[waves]\nheight = 1\n", "a.toml");
    EXPECT_EQ(scene.section("waves").number("height", "m", "wave height", Range::positive()), 1.0);
    EXPECT_NO_THROW(scene.finish());
}

TEST(SceneFile, UnknownKeyNamesPositionAndNearestKey) {
    const auto scene = SceneFile::parse("[waves]\n  heigth = 0.2\n", "a.toml");
    scene.section("waves").number("height", "m", "wave height", Range::positive(), 0.1);
    EXPECT_EQ(message_of(scene), "a.toml:2:3: waves.heigth: unknown key; did you mean 'height'?");
}

TEST(SceneFile, UnknownSectionIsRefusedWithTheNearestOne) {
    const auto scene = SceneFile::parse("[wave]\nheight = 0.2\n", "a.toml");
    EXPECT_EQ(message_of(scene), "a.toml:1:2: wave: unknown section; did you mean 'waves'?");
}

TEST(SceneFile, SectionsOfOtherStagesAreNotJudged) {
    const auto scene = SceneFile::parse("[dem]\nanything = 1\n[boussinesq]\nspacing = 0.1\n", "a.toml");
    scene.section("boussinesq").number("spacing", "m", "cell width", Range::positive());
    EXPECT_NO_THROW(scene.finish());
}

TEST(SceneFile, KeysOfForeignSectionsAreReadButTheRestStands) {
    const auto scene = SceneFile::parse("[waves]\nperiod = 2\nanything = 1\n", "a.toml");
    EXPECT_EQ(scene.foreign_section("waves").number("period", "s", "wave period", Range::positive(), 1.0),
              2.0);
    EXPECT_NO_THROW(scene.finish());
}

TEST(SceneFile, TenMistakesGiveTenLinesInFileOrder) {
    const auto scene = SceneFile::parse(
        "acuracy = 'draft'\n"     // 1 unknown top-level key
        "[time]\n"                //
        "end = -1\n"              // 2 out of range
        "window = 'long'\n"       // 3 wrong type
        "[flume]\n"               //
        "bed = [[0, -1], [1]]\n"  // 4 wrong length
        "[waves]\n"               // 5 required key missing
        "kind = 'reglar'\n"       // 6 not one of the words
        "perod = 2\n"             // 7 unknown key
        "[boussinesq]\n"          //
        "cells = 1.5\n"           // 8 not a whole number
        "dispersion = 1\n"        // 9 not a truth value
        "[wafes]\n",              // 10 unknown section
        "ten.toml");
    const auto time = scene.section("time");
    time.number("end", "s", "end", Range::positive());
    time.number("window", "s", "window", Range::positive(), 1.0);
    scene.section("flume").points("bed", "m", "bed");
    const auto waves = scene.section("waves");
    waves.number("height", "m", "wave height", Range::positive());
    waves.choice("kind", "kind", {"regular", "solitary"}, "regular");
    waves.number("period", "s", "period", Range::positive(), 1.0);
    const auto stage = scene.section("boussinesq");
    stage.integer("cells", "number of cells", Range::positive(), 100);
    stage.boolean("dispersion", "dispersion", true);
    const std::string message = message_of(scene);
    EXPECT_EQ(line_count(message), 10u) << message;
    const std::vector<std::string> expected = {
        "ten.toml:1:1: acuracy: unknown key; did you mean 'accuracy'?",
        "ten.toml:3:7: time.end: expected a number above 0 in s, got -1",
        "ten.toml:4:10: time.window: expected a number above 0 in s, got text \"long\"",
        "ten.toml:6:17: flume.bed: expected a list of 2 numbers in m, got a list of 1",
        "ten.toml:7:1: waves.height: required key is missing: wave height (a number above 0, m)",
        "ten.toml:8:8: waves.kind: expected one of regular, solitary, got text \"reglar\"; did you mean "
        "'regular'?",
        "ten.toml:9:1: waves.perod: unknown key; did you mean 'period'?",
        "ten.toml:11:9: boussinesq.cells: expected a whole number above 0, got 1.5",
        "ten.toml:12:14: boussinesq.dispersion: expected true or false, got 1",
        "ten.toml:13:2: wafes: unknown section; did you mean 'waves'?"};
    std::string joined;
    for (const auto& line : expected) joined += (joined.empty() ? "" : "\n") + line;
    EXPECT_EQ(message, joined);
}

TEST(SceneFile, AKeyAtFaultGetsOneLine) {
    const auto scene = SceneFile::parse("[waves]\nheight = 'tall'\n", "a.toml");
    const auto waves = scene.section("waves");
    if (waves.number("height", "m", "wave height", Range::positive()) > 0.5)
        waves.problem("height", "higher than the water is deep");
    EXPECT_EQ(line_count(message_of(scene)), 1u) << message_of(scene);
    EXPECT_NE(message_of(scene).find("expected a number above 0 in m, got text \"tall\""), std::string::npos);
}

TEST(SceneFile, WhatFollowsFromAStandInIsNoMistake) {
    const auto scene = SceneFile::parse("[cmps]\noffshore = 1\nspacing = 'fine'\n", "a.toml");
    const auto cmps = scene.section("cmps");
    const double spacing = cmps.number("spacing", "m", "particle spacing", Range::positive());
    if (cmps.number("offshore", "m", "wall", Range::any()) < 4 * spacing)
        cmps.problem("offshore", "less than four particles from the structure");
    EXPECT_EQ(line_count(message_of(scene)), 1u) << message_of(scene);
}

TEST(SceneFile, RangesAreToldInWords) {
    const auto told = [](const Range& range) {
        const auto scene = SceneFile::parse("[dem]\nfriction = 'much'\n", "a.toml");
        scene.section("dem").number("friction", "-", "friction", range);
        const std::string message = message_of(scene);
        const auto begin = message.find("expected "), end = message.find(", got");
        return message.substr(begin, end - begin);
    };
    EXPECT_EQ(told(Range::any()), "expected a number");
    EXPECT_EQ(told(Range::positive()), "expected a number above 0");
    EXPECT_EQ(told(Range::at_least(2)), "expected a number of at least 2");
    EXPECT_EQ(told(Range::between(0, 1)), "expected a number from 0 to 1");
    EXPECT_EQ(told({.lowest = 0, .highest = 0.5, .highest_is_open = true}),
              "expected a number from 0 and below 0.5");
    EXPECT_EQ(told({.lowest = 0, .highest = 1, .lowest_is_open = true}),
              "expected a number above 0 and at most 1");
    EXPECT_EQ(told({.highest = 3}), "expected a number of at most 3");
}

TEST(SceneFile, SyntaxErrorNamesItsPlace) {
    try {
        SceneFile::parse("[waves\nheight = 1\n", "a.toml");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, 9), "a.toml:1:") << error.what();
        EXPECT_EQ(line_count(error.what()), 1u);
    }
}

TEST(SceneFile, OverridesWinAndAreNamedInMessages) {
    const std::vector<std::string> overrides = {"waves.height=-0.2", "waves.kind=solitary",
                                                "cmps.flow.spacing=0.05"};
    const auto scene = SceneFile::parse("[waves]\nheight = 0.1\n", "a.toml", overrides);
    const auto waves = scene.section("waves");
    waves.number("height", "m", "wave height", Range::positive());
    EXPECT_EQ(waves.choice("kind", "kind", {"regular", "solitary"}, "regular"), "solitary");
    EXPECT_EQ(scene.section("cmps.flow").number("spacing", "m", "spacing", Range::positive(), 1.0), 0.05);
    EXPECT_EQ(message_of(scene),
              "--set waves.height=-0.2: waves.height: expected a number above 0 in m, got -0.2");
}

TEST(SceneFile, OverrideOfAnUnknownKeyIsRefused) {
    const std::vector<std::string> overrides = {"waves.hight=0.2"};
    const auto scene = SceneFile::parse("", "a.toml", overrides);
    scene.section("waves").number("height", "m", "wave height", Range::positive(), 0.1);
    EXPECT_EQ(message_of(scene), "--set waves.hight=0.2: waves.hight: unknown key; did you mean 'height'?");
}

TEST(SceneFile, OverrideWithoutValueIsRefused) {
    const std::vector<std::string> overrides = {"waves.height"};
    EXPECT_THROW(SceneFile::parse("", "a.toml", overrides), InputError);
    const std::vector<std::string> two_lines = {"waves.height=0.1\nx=3"};
    EXPECT_THROW(SceneFile::parse("", "a.toml", two_lines), InputError);
}

TEST(SceneFile, PerturbationIsAWholeNumberAndInTheDigestUnlessZero) {
    const auto read = [](const std::string& text) {
        auto scene = SceneFile::parse(text, "a.toml");
        return std::pair{scene.perturbation(), scene.digest()};
    };
    const auto [none, plain] = read("");
    EXPECT_EQ(none, 0);
    EXPECT_EQ(plain, SceneFile::parse("", "a.toml").digest()) << "a scene without it has the digest it had";
    EXPECT_EQ(read("perturbation = 0\n").second, plain);
    const auto [three, digest] = read("perturbation = 3\n");
    EXPECT_EQ(three, 3);
    EXPECT_NE(digest, plain);
    EXPECT_NE(digest, read("perturbation = 4\n").second);
    for (const char* wrong : {"perturbation = -1\n", "perturbation = 0.5\n", "perturbation = 'a'\n"}) {
        const auto scene = SceneFile::parse(wrong, "a.toml");
        scene.perturbation();
        EXPECT_THROW(scene.finish(), InputError) << wrong;
    }
}

TEST(SceneFile, DigestFollowsValuesNotTitleOrLayout) {
    const auto digest_of_text = [](const std::string& text, const std::string& upstream = {}) {
        const auto scene = SceneFile::parse(text, "a.toml");
        scene.root().text("title", "title", "");
        scene.section("waves").number("height", "m", "wave height", Range::positive(), 0.1);
        return scene.digest(upstream);
    };
    const auto reference = digest_of_text("[waves]\nheight = 0.1\n");
    EXPECT_EQ(reference, digest_of_text("title = 'x'\n# comment\n[waves]\n  height = 0.10\n"));
    EXPECT_EQ(reference, digest_of_text("[dem]\nfriction = 1\n")) << "a default equals the same value given";
    EXPECT_NE(reference, digest_of_text("[waves]\nheight = 0.11\n"));
    EXPECT_NE(reference, digest_of_text("[waves]\nheight = 0.1\n", "another"));
}

TEST(SceneFile, ReferenceIsItselfAScene) {
    const auto read = [](const SceneFile& scene) {
        scene.root().text("title", "title", "a \"quoted\" title");
        scene.section("flume").points("bed", "m", "bed", std::vector<Point>{{0, -0.8}, {50, -0.4}});
        const auto inner = scene.section("cmps.flow");
        inner.number("spacing", "m", "grid spacing", Range::positive(), 0.05);
        scene.section("gauges").number("H5-1", "m", "gauge", Range::any(), 3);
        for (const auto& block : scene.section("dem").tables("block")) block.text("shape", "shape", "sphere");
        scene.finish();
        return scene.digest();
    };
    const auto scene = SceneFile::parse("[[dem.block]]\nshape = 'cube27'\n[[dem.block]]\n", "a.toml");
    const auto digest = read(scene);
    const auto again = SceneFile::parse(scene.reference(), "reference");
    EXPECT_EQ(read(again), digest) << scene.reference();
}

TEST(SceneFile, FileContentEntersTheDigest) {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("tsunagi_scene_file_test_" + std::to_string(::getpid()) + "");
    std::filesystem::create_directories(folder);
    const auto digest_with = [&](const std::string& content) {
        std::ofstream(folder / "series.csv") << content;
        const auto scene =
            SceneFile::parse("[waves]\nfile = 'series.csv'\n", (folder / "scene.toml").string());
        EXPECT_EQ(scene.section("waves").file("file", "time series", true), folder / "series.csv");
        scene.finish();
        return scene.digest();
    };
    EXPECT_NE(digest_with("0, 1\n"), digest_with("0, 2\n"));
    std::filesystem::remove_all(folder);
}

TEST(SceneFile, EffectsOfOtherStagesStandAndUnknownOnesDoNot) {
    const auto scene = SceneFile::parse("[effects]\nwires = 'off'\nbraking = 'on'\n", "a.toml");
    EXPECT_EQ(read_effect_wish(scene, "breaking"), EffectWish::automatic);
    EXPECT_EQ(message_of(scene), "a.toml:3:1: effects.braking: unknown key; did you mean 'breaking'?");
}

TEST(SharedSections, GaugesAreNumbersOrTables) {
    const auto scene = SceneFile::parse(
        "[gauges]\nH1 = 3\nP1 = {x = 4, z = -0.1, kind = 'pressure', interval = 0.01}\n", "a.toml");
    const auto gauges = read_gauges(scene, 0.05);
    scene.finish();
    ASSERT_EQ(gauges.size(), 2u);
    EXPECT_EQ(gauges[0].name, "H1");
    EXPECT_EQ(gauges[0].interval, 0.05);
    EXPECT_EQ(gauges[1].kind, Gauge::Kind::pressure);
    EXPECT_EQ(gauges[1].z, -0.1);
    EXPECT_EQ(gauges[1].interval, 0.01);
}

TEST(SharedSections, BedMustAdvance) {
    const auto scene = SceneFile::parse("[flume]\nbed = [[0, -1], [2, -1], [1, -1]]\n", "a.toml");
    read_bed(scene, true);
    EXPECT_EQ(message_of(scene),
              "a.toml:2:7: flume.bed: x must increase from point to point; point 3 has x = 1 after 2");
}

TEST(SharedSections, BedLevelInterpolates) {
    const std::vector<Point> bed = {{0, -1}, {2, 0}};
    EXPECT_DOUBLE_EQ(bed_level(bed, 0.5), -0.75);
    EXPECT_DOUBLE_EQ(bed_level(bed, -1), -1);
    EXPECT_DOUBLE_EQ(bed_level(bed, 3), 0);
}
