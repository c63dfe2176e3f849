// Protects: a volume comes back from every form in which it is written; slices stand in numeric order and
// without gaps; whatever does not belong together is named; and nothing is written by halves.
#include "bn/volume.h"

#include "bn/random.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

namespace fs = std::filesystem;

std::optional<ErrorInfo> error_of_reading(const fs::path& path, AtlasLayout atlas = {}) {
  return error_of([&] { read_volume(path, atlas); });
}

TEST(NumberedPath, KnowsItsPlaceForANumber) {
  EXPECT_TRUE(has_number("a/slice_%03d.png"));
  EXPECT_TRUE(has_number("%d"));
  EXPECT_FALSE(has_number("a/%d/slice.png")) << "folders have none";
  for (const char* name :
       {"slice.png", "100%.png", "slice_%3d.png", "slice_%s.png", "%", "a%%b.png", "%00d", "%0d"}) {
    EXPECT_FALSE(has_number(name)) << name;
  }
  EXPECT_EQ(numbered_path("a/slice_%03d.png", 7), "a/slice_007.png");
  EXPECT_EQ(numbered_path("slice_%03d.png", 12345), "slice_12345.png");
  EXPECT_EQ(numbered_path("%d.png", 0), "0.png");
  EXPECT_EQ(numbered_path("5%%_%d.png", 3), "5%_3.png");
  for (const char* name : {"%d_%d.png", "%d%s", "%02d%", "slice.png"}) {
    expect_error(ErrorCode::invalid_input, [&] { numbered_path(name, 1); });
  }
  expect_error(ErrorCode::invalid_input, [] { numbered_path("%d.png", -1); });
}

TEST(Volume, ComesBackFromEveryForm) {
  const TemporaryFolder folder;
  const Image volume = random_image({6, 6, 12}, 1, SampleType::u8);
  const auto check = [&](const fs::path& written, const fs::path& read, VolumeOutput output,
                         AtlasLayout atlas) {
    const auto files = write_volume(folder / written, volume, full_metadata(), output);
    const Volume back = read_volume(folder / read, atlas);
    EXPECT_TRUE(same_picture(back.image, volume)) << written;
    EXPECT_EQ(back.files, files) << written;
    EXPECT_TRUE(back.as_recorded) << written;
    EXPECT_TRUE(back.notes.empty()) << written << ": " << back.notes[0];
    ASSERT_TRUE(back.metadata.has_value()) << written;
    EXPECT_EQ(back.metadata->recipe, full_metadata().recipe);
    for (const fs::path& file : files) fs::remove(file);
  };
  fs::create_directory(folder / "slices");
  check("slices/s_%02d.png", "slices/s_%02d.png", {}, {});
  check("slices/s_%d.png", "slices", {}, {});
  check("slices/%d.tif", "slices", {}, {});
  check("atlas.png", "atlas.png", {.atlas = {.columns = 4}}, {.columns = 4});
  check("atlas.png", "atlas.png", {.atlas = {.columns = 4}}, {.columns = 4, .rows = 3});
  check("strip.png", "strip.png", {.atlas = {.columns = 1}}, {.columns = 1});
  check("strip.tif", "strip.tif", {.atlas = {.columns = 12}}, {.columns = 12, .rows = 1});
  for (const char* name : {"a.bin", "a.h", "a.ktx2"}) check(name, name, {}, {});
  check("a.ktx2", "a.ktx2", {.slices = SliceKind::depth}, {});
}

TEST(Volume, APictureIsAVolumeOfOneSlice) {
  const TemporaryFolder folder;
  const Image picture = random_image({6, 4}, 3, SampleType::u16);
  EXPECT_EQ(write_volume(folder / "a.png", picture, {}).size(), 1u);
  EXPECT_TRUE(same_picture(read_volume(folder / "a.png").image, picture));
}

/// Slices as published stacks are named: numbers without leading zeros, between other numbers.
fs::path published(int number) {
  return "stbn_scalar_2Dx1Dx1D_128x128x64x1_" + std::to_string(number) + ".png";
}

TEST(SliceFiles, AreTakenInNumericOrderHoweverTheyAreListed) {
  const TemporaryFolder folder;
  std::vector<Image> slices;
  for (int z = 0; z < 21; ++z) {
    slices.push_back(random_image({4, 4}, 1, SampleType::u8, static_cast<std::uint64_t>(z) + 1));
    write_image(folder.path() / published(z), slices.back(), {});
  }
  const Image volume = stack_slices(slices);
  std::vector<fs::path> as_a_shell_lists_them;
  for (const std::string& name : folder.names()) as_a_shell_lists_them.push_back(folder / name);
  const Volume listed = read_volume(as_a_shell_lists_them);
  EXPECT_TRUE(same_picture(listed.image, volume));
  ASSERT_EQ(listed.notes.size(), 1u);
  EXPECT_NE(listed.notes[0].find("numeric order"), std::string::npos);
  const Volume of_folder = read_volume(folder.path());
  EXPECT_TRUE(same_picture(of_folder.image, volume));
  EXPECT_TRUE(of_folder.notes.empty()) << "a folder has no order of its own";
  EXPECT_TRUE(same_picture(read_volume(folder / "stbn_scalar_2Dx1Dx1D_128x128x64x1_%d.png").image, volume));
}

TEST(SliceFiles, GapsAreErrorsButInAListNotes) {
  const TemporaryFolder folder;
  for (const int z : {0, 1, 2, 4, 5, 9, 10}) {
    write_image(folder.path() / published(z), random_image({4, 4}, 1, SampleType::u8), {});
  }
  for (const fs::path& input : {folder.path(), folder / "stbn_scalar_2Dx1Dx1D_128x128x64x1_%d.png"}) {
    const auto error = error_of_reading(input);
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_EQ(error->what, "numbers 3, 6, 7, 8 are missing between 0 and 10");
  }
  std::vector<fs::path> list;
  for (const int z : {0, 1, 2, 4}) list.push_back(folder.path() / published(z));
  const SliceFiles chosen = slice_files(list);
  EXPECT_EQ(chosen.files, list);
  ASSERT_EQ(chosen.notes.size(), 1u);
  EXPECT_EQ(chosen.notes[0], "number 3 is missing between 0 and 4");
}

TEST(SliceFiles, NumbersThatComeTwiceAreErrors) {
  const TemporaryFolder folder;
  for (const char* name : {"s_1.png", "s_01.png", "s_2.png"}) {
    write_image(folder / name, random_image({4, 4}, 1, SampleType::u8), {});
  }
  const auto error = error_of_reading(folder.path());
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->what, "number 1 comes twice");
  EXPECT_EQ(slice_files(std::vector<fs::path>{folder / "s_%02d.png"}).files.size(), 1u) << "only two digits";
}

TEST(SliceFiles, NamesOfOtherKindsAreTakenInTheirOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"b2.png", "a10.png", "a9.png"}) {
    write_image(folder / name, random_image({4, 4}, 1, SampleType::u8), {});
  }
  const std::vector<fs::path> expected = {folder / "a9.png", folder / "a10.png", folder / "b2.png"};
  EXPECT_EQ(image_files(folder.path()), expected);
  EXPECT_EQ(slice_files(std::vector<fs::path>{folder.path()}).files, expected);
}

TEST(SliceFiles, HiddenFilesAndContactSheetsAreNoSlices) {
  const TemporaryFolder folder;
  const Image image = random_image({4, 4}, 1, SampleType::u8);
  for (const char* name : {"s_0.png", "s_1.PNG", "contact_sheet.png"}) write_image(folder / name, image, {});
  write_image(folder / "s_2.png", image, {});
  fs::rename(folder / "s_2.png", folder / ".s_2.png");
  put_bytes(folder / "._s_0.png", "a resource fork");
  put_bytes(folder / "readme.txt", "text");
  put_bytes(folder / "a.dds.json", "{}");
  fs::create_directory(folder / "s_3.png");
  EXPECT_EQ(image_files(folder.path()), (std::vector<fs::path>{folder / "s_0.png", folder / "s_1.PNG"}));
  EXPECT_EQ(read_volume(folder.path()).image.depth, 2);
}

TEST(SliceFiles, WhatIsNotThereIsNamed) {
  const TemporaryFolder folder;
  expect_error(ErrorCode::invalid_input, [] { read_volume(std::span<const fs::path>{}); });
  EXPECT_EQ(error_of_reading(folder.path())->code, ErrorCode::invalid_input);
  EXPECT_NE(error_of_reading(folder / "s_%03d.png")->remedy.find("s_000.png"), std::string::npos);
  EXPECT_EQ(error_of_reading(folder / "missing" / "s_%03d.png")->code, ErrorCode::io);
  EXPECT_EQ(error_of_reading(folder / "missing.png")->code, ErrorCode::io);
}

TEST(SliceFiles, NamesOfImagesAreThoseOfEveryFormatThatIsRead) {
  for (const char* name : {"a.png", "A.PNG", "x/b.webp", "c.Pbm", "d.tiff", "e.h", ".f.exr"})
    EXPECT_TRUE(has_image_name(name)) << name;
  for (const char* name : {"", "png", ".png", "a.txt", "a.png.json", "dir/"})
    EXPECT_FALSE(has_image_name(name)) << name;
}

TEST(SliceFiles, AnOutputThatWouldReplaceAnInputIsFound) {
  const TemporaryFolder folder;
  for (const char* name : {"s_0.png", "s_1.png", "m.png"}) put_bytes(folder / name, "");
  std::filesystem::create_symlink(folder / "m.png", folder / "link.png");
  EXPECT_TRUE(would_replace(folder / "m.png", folder / "m.png"));
  EXPECT_TRUE(would_replace(folder / "link.png", folder / "m.png"));
  EXPECT_TRUE(would_replace(folder / "sub/../m.png", folder.path()));
  EXPECT_TRUE(would_replace(folder / "s_1.png", folder / "s_%d.png"));
  EXPECT_TRUE(would_replace(folder / "s_%d.png", folder / "s_0.png"));
  EXPECT_TRUE(would_replace(folder / "gone.png", folder / "gone.png"));
  EXPECT_FALSE(would_replace(folder / "s_2.png", folder / "s_%d.png"));
  EXPECT_FALSE(would_replace(folder / "n.png", folder / "m.png"));
  EXPECT_FALSE(would_replace(folder / "t_%d.png", folder.path()));
}

TEST(Volume, SlicesUnlikeTheFirstAreNamed) {
  for (const Image& other : {random_image({4, 5}, 1, SampleType::u8), random_image({4, 4}, 3, SampleType::u8),
                             random_image({4, 4}, 1, SampleType::u16)}) {
    const TemporaryFolder folder;
    write_image(folder / "s_0.png", random_image({4, 4}, 1, SampleType::u8), {});
    write_image(folder / "s_1.png", random_image({4, 4}, 1, SampleType::u8), {});
    write_image(folder / "s_2.png", other, {});
    const auto error = error_of_reading(folder.path());
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_EQ(error->where, (folder / "s_2.png").string());
    EXPECT_NE(error->limit.find("4x4 pixels, 1 channel, 8bit, as " + (folder / "s_0.png").string()),
              std::string::npos)
        << error->limit;
  }
  const TemporaryFolder folder;
  write_image(folder / "s_0.bin", random_image({4, 4, 2}, 1, SampleType::u8), {});
  write_image(folder / "s_1.bin", random_image({4, 4, 2}, 1, SampleType::u8), {});
  EXPECT_EQ(error_of_reading(folder.path())->code, ErrorCode::invalid_input);
}

TEST(Volume, AnAtlasThatItsColumnsDoNotDivideIsRefused) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", random_image({12, 8}, 1, SampleType::u8), {});
  EXPECT_EQ(read_volume(folder / "a.png", {.columns = 3}).image.shape(), (Shape{4, 4, 6}));
  EXPECT_EQ(read_volume(folder / "a.png", {.columns = 3, .rows = 1}).image.shape(), (Shape{4, 8, 3}));
  for (const AtlasLayout atlas : {AtlasLayout{5, 1}, AtlasLayout{3, 3}, AtlasLayout{2, 0}, AtlasLayout{-1, 1},
                                  AtlasLayout{3, -1}, AtlasLayout{1, 0}, AtlasLayout{1 << 30, 1}}) {
    const auto error = error_of_reading(folder / "a.png", atlas);
    ASSERT_TRUE(error.has_value()) << atlas.columns << " " << atlas.rows;
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
  }
  write_image(folder / "v.bin", random_image({4, 4, 2}, 1, SampleType::u8), {});
  EXPECT_EQ(error_of_reading(folder / "v.bin", {.columns = 1})->code, ErrorCode::invalid_input);
}

TEST(Volume, SamplesThatWereChangedSinceAreNoted) {
  const TemporaryFolder folder;
  write_volume(folder / "s_%d.bin", random_image({4, 4, 3}, 1, SampleType::u8), full_metadata());
  EXPECT_TRUE(read_volume(folder.path()).as_recorded);
  std::string bytes = bytes_of(folder / "s_1.bin");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  put_bytes(folder / "s_1.bin", bytes);
  const Volume volume = read_volume(folder.path());
  EXPECT_FALSE(volume.as_recorded);
  ASSERT_EQ(volume.notes.size(), 1u);
  EXPECT_NE(volume.notes[0].find("s_1.bin"), std::string::npos);
}

TEST(Volume, NothingIsWrittenUnlessAllCanBe) {
  const TemporaryFolder folder;
  const Image volume = random_image({4, 4, 6}, 1, SampleType::u8);
  const auto refused = [&](const char* name, VolumeOutput output = {}) {
    const std::vector<std::string> before = folder.names();
    const auto error = error_of([&] { write_volume(folder / name, volume, {}, output); });
    ASSERT_TRUE(error.has_value()) << name;
    EXPECT_EQ(error->code, ErrorCode::invalid_input) << error->what;
    EXPECT_FALSE(error->remedy.empty() && error->limit.empty()) << error->what;
    EXPECT_EQ(folder.names(), before);
  };
  refused("slices.png");
  refused("slices.exr");
  refused("slices_%3d.png");
  refused("slices_%d_%d.png");
  refused("slices_%d.xyz");
  refused("slices_%d.png", {.atlas = {.columns = 2}});
  refused("atlas.png", {.atlas = {.columns = 4}});
  refused("atlas.png", {.atlas = {.columns = 2, .rows = 2}});
  refused("atlas.png", {.atlas = {.columns = -1}});
  // A reader of the pattern would take this for a seventh slice.
  put_bytes(folder / "s_006.png", "");
  refused("s_%03d.png");
  EXPECT_NO_THROW(write_volume(folder / "s_%02d.png", volume, {}));
  // One of the paths cannot be written.
  fs::create_directory(folder / "t_3.png");
  expect_error(ErrorCode::io, [&] { write_volume(folder / "t_%d.png", volume, {}); });
  EXPECT_FALSE(fs::exists(folder / "t_0.png"));
}

TEST(Volume, SlicesGetAFolderOfTheirOwn) {
  const TemporaryFolder here;
  const Image image{.size = {2, 2},
                    .depth = 3,
                    .channels = 1,
                    .type = SampleType::u8,
                    .samples = std::vector<std::byte>(12)};
  EXPECT_NO_THROW(check_volume_writable(here / "new/s_%d.png", image.shape(), image.type, 1));
  EXPECT_FALSE(fs::exists(here / "new")) << "a check writes nothing";
  EXPECT_EQ(write_volume(here / "new/s_%d.png", image, {}).size(), 3u);
  EXPECT_TRUE(fs::exists(here / "new/s_2.png"));
  // One folder, not a path of them; and one file has none of its own.
  EXPECT_THROW(check_volume_writable(here / "no/new/s_%d.png", image.shape(), image.type, 1), Error);
  EXPECT_THROW(check_volume_writable(here / "other/s.ktx2", image.shape(), image.type, 1), Error);
  EXPECT_THROW(check_volume_writable(here / "new2/s_%d.gif", image.shape(), image.type, 1), Error);
}

TEST(Volume, TheMemoryLimitIsAppliedToAllSlices) {
  const TemporaryFolder folder;
  write_volume(folder / "s_%d.bin", random_image({64, 64, 8}, 1, SampleType::u8), {});
  const Execution execution{.memory_limit_bytes = 8 * 4096};
  const auto error = error_of([&] { read_volume(folder.path(), {}, execution); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::over_limit);
  EXPECT_NO_THROW(read_volume(folder.path(), {}, {.memory_limit_bytes = 10 * 4096}));
}

TEST(Volume, AStopIsHonoured) {
  const TemporaryFolder folder;
  write_volume(folder / "s_%d.bin", random_image({4, 4, 2}, 1, SampleType::u8), {});
  std::stop_source source;
  source.request_stop();
  expect_error(ErrorCode::cancelled, [&] { read_volume(folder.path(), {}, {.stop = source.get_token()}); });
}

}  // namespace
}  // namespace bn::texture
