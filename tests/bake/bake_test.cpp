// Protects: a bake makes every file it was asked for, the same bytes with any number of threads; the
// second bake does nothing, a stopped or killed one is completed to the same bytes; errors come
// before work, and a folder has one bake at a time.
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>

#include "bake/folder_lock.h"
#include "bake/manifest.h"
#include "bn/error.h"
#include "fixtures.h"

namespace bn {
using namespace baking;

namespace {

using Contents = std::map<std::string, std::string>;

const Contents& reference_contents() {
  static const Contents contents = [] {
    const TemporaryFolder out;
    bake(small_recipe(), {.out_dir = out}, {.threads = 1});
    return contents_of(out);
  }();
  return contents;
}

int skipped(const BakeResult& result) {
  return static_cast<int>(
      std::count_if(result.jobs.begin(), result.jobs.end(), [](auto& job) { return job.skipped; }));
}

TEST(Bake, MakesWhatTheRecipeNamesAndItVerifies) {
  const TemporaryFolder out;
  const BakeResult result = bake(small_recipe(), {.out_dir = out});
  ASSERT_EQ(result.jobs.size(), 5u);
  for (const char* file :
       {"masks/small.png", "masks/small.exr", "masks/small16.png", "masks/small.h", "masks/small.bin",
        "masks/small.tif", "odd.png", "set/tile.png", "set/atlas.png", "set/gather.png", "set/right.bin",
        "euclidean.png", "contact_sheet.png", "manifest.json"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  EXPECT_EQ(contents_of(out).size(), 14u) << "no litter";
  EXPECT_EQ(failures(verify_path(out)), "");

  const JobRecord& set = result.jobs[2];
  EXPECT_EQ(set.name, "set");
  ASSERT_EQ(set.tiles.size(), 9u);
  EXPECT_EQ(set.tiles[5].motion, (Offset{1, 0}));
  EXPECT_EQ(set.facts.get<Offset>("step"), auto_step({16, 16}).step);
  EXPECT_EQ(set.files[3].tiles.at(0), set.tiles[5]);
  for (const TileRecord& tile : set.tiles) EXPECT_EQ(tile.energy, tile.lower_bound);
}

TEST(Bake, GivesTheSameBytesWithAnyNumberOfThreads) {
  for (const int threads : {2, 3, 7}) {
    const TemporaryFolder out;
    bake(small_recipe(), {.out_dir = out}, {.threads = threads});
    EXPECT_EQ(contents_of(out), reference_contents()) << threads << " threads";
  }
}

TEST(Bake, TheSecondBakeDoesNothing) {
  const TemporaryFolder out;
  bake(small_recipe(), {.out_dir = out});
  const auto atlas_time = fs::last_write_time(out / "set/atlas.png");
  EXPECT_TRUE(std::ranges::all_of(plan_bake(small_recipe(), {.out_dir = out}).jobs, &PlannedJob::up_to_date));
  EXPECT_EQ(skipped(bake(small_recipe(), {.out_dir = out})), 5);
  EXPECT_EQ(fs::last_write_time(out / "set/atlas.png"), atlas_time);
  EXPECT_EQ(contents_of(out), reference_contents());
}

TEST(Bake, ForceDoesEverythingAgain) {
  const TemporaryFolder out;
  bake(small_recipe(), {.out_dir = out});
  EXPECT_EQ(skipped(bake(small_recipe(), {.out_dir = out, .force = true})), 0);
  EXPECT_EQ(contents_of(out), reference_contents());
}

TEST(Bake, AnEditedEntryRedoesWhatDependsOnItAndNothingElse) {
  const TemporaryFolder out;
  bake(small_recipe(), {.out_dir = out});
  Recipe edited = small_recipe();
  const auto other = std::make_shared<MaskEntry>(mask_of(edited, 1));
  other->void_and_cluster.seed = 8;
  *std::find_if(edited.entries.begin(), edited.entries.end(),
                [&](auto& entry) { return entry->name == other->name; }) = other;
  const BakeResult result = bake(edited, {.out_dir = out});
  EXPECT_TRUE(result.jobs[0].skipped) << "the other mask";
  EXPECT_FALSE(result.jobs[1].skipped) << "the edited mask";
  EXPECT_TRUE(result.jobs[2].skipped) << "the other set";
  EXPECT_FALSE(result.jobs[3].skipped) << "the set of the edited mask";
  EXPECT_FALSE(result.jobs[4].skipped) << "the contact sheet";
  EXPECT_EQ(failures(verify_path(out)), "");
}

TEST(Bake, ADamagedOrMissingFileIsMadeAgain) {
  const TemporaryFolder out;
  for (const char* file : {"masks/small.png", "masks/small.bin", "set/atlas.png", "contact_sheet.png"}) {
    bake(small_recipe(), {.out_dir = out});
    fs::remove(out / file);
    EXPECT_LT(skipped(bake(small_recipe(), {.out_dir = out})), 5) << file;
    EXPECT_EQ(contents_of(out), reference_contents()) << file;
    std::string bytes = bytes_of(out / file);
    bytes[bytes.size() / 2] ^= 1;
    write_bytes(out / file, bytes);
    EXPECT_LT(skipped(bake(small_recipe(), {.out_dir = out})), 5) << file;
    EXPECT_EQ(contents_of(out), reference_contents()) << file;
  }
}

TEST(Bake, ABrokenManifestCostsOnlyTime) {
  const TemporaryFolder out;
  for (const char* text :
       {"", "{", "[]", "{\"manifest_version\": 1}", "{\"manifest_version\": 1, \"recipe\": 3}"}) {
    bake(small_recipe(), {.out_dir = out});
    write_bytes(out / "manifest.json", text);
    EXPECT_EQ(skipped(bake(small_recipe(), {.out_dir = out})), 0);
    EXPECT_EQ(contents_of(out), reference_contents());
  }
}

// --- stop, kill, resume --------------------------------------------------------------------------

TEST(Bake, StoppedAfterAnyJobItGoesOnToTheSameBytes) {
  for (int jobs = 1; jobs <= 4; ++jobs) {
    const TemporaryFolder out;
    std::stop_source stop;
    int finished = 0;
    try {
      bake(small_recipe(), {.out_dir = out}, {.threads = 1, .stop = stop.get_token()},
           [&](const BakeEvent& event) {
             if (std::holds_alternative<JobFinished>(event) && ++finished == jobs) stop.request_stop();
           });
      FAIL() << "not stopped";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    EXPECT_FALSE(read_manifest(out / "manifest.json").complete);
    const BakeResult rest = bake(small_recipe(), {.out_dir = out});
    EXPECT_EQ(skipped(rest), jobs);
    EXPECT_EQ(contents_of(out), reference_contents());
  }
}

TEST(Bake, KilledAtAnyEventItGoesOnToTheSameBytes) {
  const TemporaryFolder out;
  bool finished = false;
  for (int kill_at = 1; !finished; ++kill_at) {
    const pid_t child = ::fork();
    if (child == 0) {
      int told = 0;
      const auto kill_at_event = [&](const BakeEvent&) {
        if (++told == kill_at) ::raise(SIGKILL);
      };
      try {
        bake(small_recipe(), {.out_dir = out, .force = true}, {.threads = 1}, kill_at_event);
      } catch (const std::exception&) {
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    finished = !WIFSIGNALED(status);
    EXPECT_TRUE(!finished || kill_at > 10) << "there are more events than that";
    // Whatever was written so far is whole.
    for (const auto& [name, bytes] : contents_of(out)) {
      const auto whole = reference_contents().find(name);
      if (whole == reference_contents().end() || name == "manifest.json") continue;
      EXPECT_EQ(bytes, whole->second) << name;
    }
  }
  bake(small_recipe(), {.out_dir = out});
  Contents contents = contents_of(out);
  // A kill between naming a temporary and renaming it leaves it behind; nothing else may differ.
  std::erase_if(contents, [](const auto& file) { return file.first.find(".bn-tmp") != std::string::npos; });
  EXPECT_EQ(contents, reference_contents());
}

// --- one bake in a folder ------------------------------------------------------------------------

TEST(Bake, TwoBakesIntoOneFolderAreRefused) {
  const TemporaryFolder out;
  const FolderLock other(out);
  try {
    bake(small_recipe(), {.out_dir = out});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io);
    EXPECT_NE(std::string(error.what()).find("another bake"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_empty(out));
}

TEST(Bake, AFolderThatCannotBeMadeIsAnIoError) {
  try {
    bake(small_recipe(), {.out_dir = "/proc/bn-bake"});  // not even root may
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io);
    EXPECT_NE(std::string(error.what()).find("/proc"), std::string::npos) << error.what();
  }
}

// --- events --------------------------------------------------------------------------------------

TEST(Bake, ReportsProgressThatNeverRunsBackwardsAndEndsAtOne) {
  const TemporaryFolder out;
  std::vector<double> done;
  std::vector<std::string> started, finished, written;
  bake(small_recipe(), {.out_dir = out}, {.threads = 3}, [&](const BakeEvent& event) {
    if (const auto* progress = std::get_if<BakeProgress>(&event)) done.push_back(progress->done);
    if (const auto* start = std::get_if<JobStarted>(&event)) started.push_back(start->job.name);
    if (const auto* finish = std::get_if<JobFinished>(&event)) finished.push_back(finish->job.name);
    if (const auto* file = std::get_if<FileWritten>(&event)) written.push_back(file->file.path);
  });
  ASSERT_FALSE(done.empty());
  EXPECT_TRUE(std::ranges::is_sorted(done));
  EXPECT_EQ(done.back(), 1.0);
  EXPECT_EQ(started.size(), 5u);
  EXPECT_EQ(finished.size(), 5u);
  EXPECT_EQ(written.size(), 13u);
  EXPECT_EQ(finished.back(), "contact_sheet");
}

// --- single files --------------------------------------------------------------------------------

TEST(MakeMask, WritesAFileThatVerifiesAndWhoseRecipeMakesItAgain) {
  const TemporaryFolder folder, again;
  make_entry(a_mask("mask", {.size = {16, 8}, .seed = 3}, folder / "mask.png"));
  EXPECT_EQ(failures(verify_path(folder / "mask.png")), "");
  const std::string recipe = read_image(folder / "mask.png").metadata->recipe;
  bake(parse_recipe(recipe, "embedded", again), {.out_dir = again});
  EXPECT_EQ(bytes_of(again / "mask.png"), bytes_of(folder / "mask.png"));
}

TEST(MakeRetarget, WritesAFileThatVerifiesAndWhoseRecipeMakesItAgain) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "tiles");
  make_entry(a_mask("mask", {.size = {16, 16}}, folder / "mask.png"));
  RetargetEntry entry = a_set("tile", folder / "mask.png");
  entry.problem.radius = 3;
  entry.motion = 1;
  entry.outputs = {{.path = (folder / "tiles/atlas.png").string(), .kind = RetargetOutput::Kind::atlas},
                   {.path = (folder / "tiles/tile.png").string()}};
  const JobRecord job = make_entry(entry);
  EXPECT_EQ(job.tiles.size(), 9u);
  EXPECT_EQ(failures(verify_path(folder)), "");
  const Metadata metadata = *read_image(folder / "tiles/atlas.png").metadata;
  EXPECT_EQ(metadata.facts.get<std::string>("source"), "../mask.png");
  const std::string before = bytes_of(folder / "tiles/atlas.png");
  fs::remove(folder / "tiles/atlas.png");
  bake(parse_recipe(metadata.recipe, "embedded", folder / "tiles"), {.out_dir = folder / "tiles"});
  EXPECT_EQ(bytes_of(folder / "tiles/atlas.png"), before);
}

TEST(WriteRetarget, WritesTheFileThatMakeRetargetMakes) {
  const TemporaryFolder out;
  make_entry(a_mask("m", {.size = {32, 32}}, out / "m.png"));
  RetargetEntry entry = a_set("t", out / "m.png");
  entry.step = Offset{11, 7};
  entry.anneals = true;
  entry.anneal = AnnealMethod{.options = {.proposals = 100'000}};
  for (const Offset motion : {Offset{0, 0}, Offset{-1, 1}}) {
    entry.motion = motion == Offset{0, 0} ? 0 : 1;
    entry.outputs = {{.path = (out / "made.png").string(), .form = MoveForm::gather, .motion = motion}};
    make_entry(entry);
    const FileContent made = read_image(out / "made.png");

    AnnealProblem problem;
    problem.channels = {{levels_of_channel(read_image(entry.image).image, 0).value}};
    problem.retarget.step = *entry.step;
    problem.retarget.motion = motion;
    RetargetTile tile = anneal_retarget(problem, {.proposals = 100'000}).tile;
    tile.lower_bound = made.metadata->tiles.at(0).lower_bound;
    entry.outputs[0].path = (out / "written.png").string();
    const JobRecord job = write_retarget(entry, tile);
    EXPECT_EQ(job.files.at(0).pixel_hash, made.metadata->pixel_hash);
    EXPECT_EQ(read_image(out / "written.png").metadata->tiles, made.metadata->tiles);
    EXPECT_EQ(failures(verify_path(out / "written.png")), "");

    // A tile that is not what it says never becomes a file.
    fs::remove(out / "written.png");
    for (int lie = 0; lie < 4; ++lie) {
      RetargetTile wrong = tile;
      if (lie == 0) std::swap(wrong.move[0], wrong.move[1]);
      if (lie == 1) --wrong.energy;
      if (lie == 2) ++wrong.start_energy;
      if (lie == 3) wrong.lower_bound = wrong.energy + 1;
      EXPECT_THROW(write_retarget(entry, wrong), Error) << lie;
    }
    EXPECT_FALSE(fs::exists(out / "written.png"));
    entry.outputs[0].kind = RetargetOutput::Kind::atlas;
    EXPECT_THROW(write_retarget(entry, tile), Error);
  }
}

TEST(MakeMask, ChecksItsOptionsBeforeTheWork) {
  const TemporaryFolder folder;
  const MaskEntry sound = a_mask("mask", {.size = {16, 8}}, folder / "mask.png");
  const auto refused = [&](auto change, const std::string& says) {
    MaskEntry entry = sound;
    change(entry);
    try {
      make_entry(entry);
      ADD_FAILURE() << "accepted: " << says;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  refused([](MaskEntry& entry) { entry.void_and_cluster.sigma_px = 17.0; }, "sigma is 17 (allowed: 0.3..16)");
  refused([](MaskEntry& entry) { entry.void_and_cluster.seed = ~std::uint64_t{0}; }, "");
  refused([&](MaskEntry& entry) { entry.outputs[0].path = (folder / "\xff.png").string(); }, "");
  refused([&](MaskEntry& entry) { entry.outputs[0].path = (folder / "mask.jpg").string(); }, ".png");
  EXPECT_TRUE(fs::is_empty(folder));
}

/// A grey picture whose pixel (x, y) is value(x, y), as a PNG without metadata of a mask.
template <class Value>
std::string make_picture(const fs::path& path, Extent size, Value value) {
  Image image{.size = size, .channels = 1, .type = SampleType::u8, .samples = {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) image.samples.push_back(static_cast<std::byte>(value(x, y)));
  }
  write_image(path, image, {});
  return path.string();
}

std::string notes_for(const std::string& image, RetargetEntry entry, const fs::path& out) {
  entry.name = "tile";
  entry.image = image;
  entry.outputs = {{.path = out.string()}};
  std::string notes;
  for (const std::string& note : make_entry(entry).notes) notes += note + "\n";
  return notes;
}

TEST(MakeRetarget, AcceptsUnusualSourcesWithANote) {
  const TemporaryFolder folder;
  const Extent size{16, 16};
  RetargetEntry plain;
  plain.problem.radius = 3;
  const auto constant = make_picture(folder / "constant.png", size, [](int, int) { return 7; });
  EXPECT_NE(notes_for(constant, plain, folder / "a.png").find("constant"), std::string::npos);
  const auto checker = make_picture(folder / "checker.png", size, [](int x, int y) { return (x + y) % 2; });
  EXPECT_NE(notes_for(checker, plain, folder / "b.png").find("two levels"), std::string::npos);
  const auto ramp = make_picture(folder / "ramp.png", size, [](int x, int y) { return x * (y + 1); });
  EXPECT_NE(notes_for(ramp, plain, folder / "c.png").find("no permutation"), std::string::npos);
  const auto rank =
      make_picture(folder / "rank.png", size, [](int x, int y) { return (x * 16 + y) * 37 % 256; });
  EXPECT_EQ(notes_for(rank, plain, folder / "d.png"), "");
  RetargetEntry unusual = plain;
  unusual.step = {{32, -16}};
  unusual.problem.radius = 9;
  const std::string notes = notes_for(rank, unusual, folder / "e.png");
  EXPECT_NE(notes.find("the step is 0"), std::string::npos) << notes;
  EXPECT_NE(notes.find("radius 9 reaches around the tile"), std::string::npos) << notes;
  RetargetEntry early = plain;
  early.step = {{12, 8}};
  EXPECT_NE(notes_for(rank, early, folder / "f.png").find("repeats after 4 frames"), std::string::npos);
  EXPECT_EQ(failures(verify_path(folder / "a.png")) + failures(verify_path(folder / "e.png")), "");
  plain.motion = 8;
  EXPECT_THROW(notes_for(rank, plain, folder / "g.png"), Error) << "motion larger than the tile";
}

}  // namespace
}  // namespace bn
