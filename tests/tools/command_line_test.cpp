// Protects: every word of a command line means something or is an error that names it; a misspelling is
// answered with the nearest known word; global options stand before or after the verb; the help shows
// every option of a verb.
#include "tools/command_line.h"

#include <gtest/gtest.h>

#include "bn/error.h"
#include "tools/help_text.h"

namespace bn::tools {
namespace {

/// Two plain verbs and a group of two methods, with what they were given.
struct Fixture {
  std::string file;
  int radius = 6;
  Extent size{64, 64};
  std::filesystem::path out;
  bool wrap = true;
  GlobalOptions globals;
  Arguments global_arguments = declare(globals);
  std::vector<Verb> verbs;

  Fixture() {
    Verb solve{.name = "solve",
               .summary = "Solve it.",
               .examples = {{"bn solve a", "one"}},
               .details = "It solves."};
    solve.arguments.positional("FILE", file,
                               {.placeholder = "",
                                .allowed = "",
                                .parse = [](auto text, auto) { return std::string(text); },
                                .show = {}},
                               "The file.");
    solve.arguments.option("--radius", radius, integer_in(1, 32), "How far.");
    solve.arguments.flag("--no-wrap", wrap, false, "Stay inside.");
    Verb make{.name = "noise make",
              .summary = "Make it.",
              .examples = {{"bn noise make", "one"}},
              .details = "It makes."};
    make.arguments.option("--size", size, extent_in(1, 16), "How large.");
    make.arguments.required_option("--out", out, file_path(), "Where.", "-o");
    Verb other{.name = "noise other",
               .summary = "Other.",
               .examples = {{"bn noise other", "one"}},
               .details = "Other."};
    verbs = {solve, make, other};
  }

  Invocation parse(const std::vector<std::string>& words) {
    return parse_command_line(words, verbs, global_arguments);
  }

  std::string refusal(const std::vector<std::string>& words) {
    try {
      parse(words);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      return error.what();
    }
    return "accepted";
  }
};

TEST(CommandLine, AssignsWhatIsGivenAndKeepsTheRest) {
  Fixture f;
  const auto invocation = f.parse({"--threads", "3", "solve", "a.png", "--no-wrap", "--radius=5", "-q"});
  ASSERT_NE(invocation.verb, nullptr);
  EXPECT_EQ(invocation.verb->name, "solve");
  EXPECT_EQ(f.file, "a.png");
  EXPECT_EQ(f.radius, 5);
  EXPECT_FALSE(f.wrap);
  EXPECT_TRUE(f.globals.quiet);
  EXPECT_EQ(f.globals.threads, 3);
  EXPECT_EQ(f.size, (Extent{64, 64}));
}

TEST(CommandLine, AListTakesAllTheWordsThatAreLeft) {
  Fixture f;
  std::vector<std::filesystem::path> files;
  Verb look{.name = "look", .summary = "Look.", .examples = {{"bn look a b", "two"}}, .details = "It looks."};
  look.arguments.positional_list("FILE", files, file_path(), "The files.");
  look.arguments.option("--radius", f.radius, integer_in(1, 32), "How far.");
  f.verbs.push_back(look);
  f.parse({"look", "a.png", "b.png", "--radius", "5", "c.png", "--threads", "2"});
  EXPECT_EQ(files, (std::vector<std::filesystem::path>{"a.png", "b.png", "c.png"}));
  EXPECT_EQ(f.radius, 5);
  EXPECT_NE(f.refusal({"look"}).find("FILE is missing"), std::string::npos);
  EXPECT_NE(verb_help(look, f.global_arguments).find("bn look FILE... [OPTIONS]"), std::string::npos);
}

TEST(CommandLine, FindsMethodsOfAGroup) {
  Fixture f;
  EXPECT_EQ(f.parse({"noise", "make", "--size", "3x4", "-o", "x.png", "--threads", "2"}).verb->name,
            "noise make");
  EXPECT_EQ(f.size, (Extent{3, 4}));
  EXPECT_EQ(f.out, "x.png");
  EXPECT_EQ(f.globals.threads, 2);
  const auto group = f.parse({"noise"});
  EXPECT_EQ(group.verb, nullptr);
  EXPECT_EQ(group.group, "noise");
  EXPECT_EQ(f.refusal({"noise", "mkae"}), "noise: there is no method 'mkae'; did you mean bn noise make?");
}

TEST(CommandLine, AFileMayBeNamedLikeAVerb) {
  Fixture f;
  EXPECT_EQ(f.parse({"solve", "noise"}).verb->name, "solve");
  EXPECT_EQ(f.file, "noise");
  EXPECT_EQ(f.parse({"solve", "solve"}).verb->name, "solve");
  EXPECT_EQ(f.file, "solve");
  EXPECT_EQ(f.parse({"solve", "--", "--radius"}).verb->name, "solve");
  EXPECT_EQ(f.file, "--radius");
}

TEST(CommandLine, SuggestsForMisspeltWords) {
  Fixture f;
  EXPECT_EQ(f.refusal({"slove", "a.png"}), "there is no verb 'slove'; did you mean bn solve?");
  EXPECT_EQ(f.refusal({"solve", "a.png", "--raduis", "5"}),
            "solve: there is no option '--raduis'; did you mean --radius?");
  EXPECT_EQ(f.refusal({"solve", "a.png", "--thread=5"}),
            "solve: there is no option '--thread'; did you mean --threads?");
  EXPECT_EQ(f.refusal({"solve", "a.png", "--zzz"}), "solve: there is no option '--zzz'; see bn solve --help");
  EXPECT_EQ(f.refusal({"solve", "a.png", "--rad", "5"}),
            "solve: there is no option '--rad'; did you mean --radius?");
  EXPECT_EQ(f.refusal({"noise", "make", "--output", "a"}),
            "noise make: there is no option '--output'; did you mean --out?");
  EXPECT_EQ(f.refusal({"solve", "a.png", "-x"}), "solve: there is no option '-x'; see bn solve --help");
}

TEST(CommandLine, RefusesMissingSurplusAndRepeatedWords) {
  Fixture f;
  EXPECT_EQ(f.refusal({"solve"}), "solve: FILE is missing; see bn solve --help");
  EXPECT_EQ(f.refusal({"solve", "a", "b"}), "solve: unexpected argument 'b'; see bn solve --help");
  EXPECT_EQ(f.refusal({"noise", "make"}), "noise make: --out FILE is missing; see bn noise make --help");
  EXPECT_EQ(f.refusal({"noise", "make", "-o", ""}), "--out: a value is missing; write --out FILE");
  EXPECT_EQ(f.refusal({"solve", "a", "--radius"}),
            "--radius: a value is missing (allowed: 1..32); write --radius N");
  EXPECT_EQ(f.refusal({"solve", "a", "--radius", "--no-wrap"}),
            "--radius: a value is missing (allowed: 1..32); write --radius N");
  EXPECT_EQ(f.refusal({"solve", "a", "--radius", "5", "--radius=6"}),
            "--radius: given 2 times, as '5' and '6'; give it once");
  EXPECT_EQ(f.refusal({"solve", "a", "--no-wrap=1"}), "solve: a switch takes no value; see bn solve --help");
  EXPECT_EQ(f.refusal({""}), "there is no verb ''; see bn --help");
  EXPECT_EQ(f.radius, 6);
}

TEST(CommandLine, NegativeNumbersAreValues) {
  Fixture f;
  EXPECT_EQ(f.refusal({"solve", "a", "--radius", "-5"}), "--radius: '-5' is out of range (allowed: 1..32)");
}

TEST(CommandLine, HelpWinsOverEveryMistake) {
  Fixture f;
  EXPECT_EQ(f.parse({"solve", "--zzz", "--radius", "x", "--help"}).verb->name, "solve");
  EXPECT_TRUE(f.globals.help);
  EXPECT_EQ(f.radius, 6);
}

TEST(HelpText, OpensWithExamplesAndNamesEverything) {
  Fixture f;
  for (const auto& verb : f.verbs) {
    const std::string text = verb_help(verb, f.global_arguments);
    EXPECT_TRUE(text.starts_with("Examples\n")) << text;
    for (const auto& argument : verb.arguments.list()) {
      EXPECT_NE(text.find(argument.name), std::string::npos) << argument.name;
      EXPECT_NE(text.find(argument.help), std::string::npos) << argument.name;
      EXPECT_NE(text.find(argument.allowed), std::string::npos) << argument.name;
    }
  }
  const std::string text = verb_help(f.verbs[0], f.global_arguments);
  EXPECT_NE(text.find("Usage: bn solve FILE [OPTIONS]"), std::string::npos) << text;
  EXPECT_NE(text.find("Allowed: 1..32. Default: 6."), std::string::npos) << text;
}

TEST(HelpText, NoLineIsWiderThanAHundredColumns) {
  Fixture f;
  f.verbs[0].details =
      std::string(40, 'a') + " " + std::string(70, 'b') + " c\n\n" + std::string(99, 'd') + " e";
  std::string text = verb_help(f.verbs[0], f.global_arguments) + overview_help(f.verbs, f.global_arguments);
  while (!text.empty()) {
    const auto end = text.find('\n');
    ASSERT_NE(end, std::string::npos) << "every line ends";
    EXPECT_LE(end, 100u) << text.substr(0, end);
    text.erase(0, end + 1);
  }
}

}  // namespace
}  // namespace bn::tools
