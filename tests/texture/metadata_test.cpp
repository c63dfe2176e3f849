// Protects: metadata come back whole whatever they contain, what is broken is said and never guessed,
// and nothing of the machine or the time gets into a file.
#include <cstdlib>

#include "bn/error.h"
#include "texture/fixtures.h"
#include "texture/metadata.h"

namespace bn::texture {
namespace {

/// JSON of full_metadata() with one part replaced.
std::string edited(const std::string& part, const std::string& by) {
  std::string json = to_json(full_metadata());
  const std::size_t at = json.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return json.replace(at, part.size(), by);
}

TEST(Metadata, JsonRoundTrip) {
  for (const Metadata& metadata : {Metadata{}, full_metadata()}) {
    for (const int indent : {-1, 0, 2}) EXPECT_EQ(metadata_from_json(to_json(metadata, indent)), metadata);
  }
  EXPECT_EQ(metadata_from_json(to_json(full_metadata())).tiles.size(), 81u);
}

TEST(Metadata, JsonIsOneAsciiLine) {
  for (const char c : to_json(full_metadata())) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << static_cast<int>(c);
}

TEST(Metadata, Golden) {
  // The schema of docs/files.md. A change of it is a new kMetadataVersion.
  Metadata metadata;
  metadata.tool_version = "1.2.3";
  metadata.algorithm = "retarget-exact";
  metadata.algorithm_version = 1;
  metadata.kind = "retarget-tile";
  metadata.recipe = "a = 1\n";
  metadata.facts.add("seed", 7);
  metadata.facts.add("step", Offset{48, 36});
  metadata.facts.add("radius", 6);
  metadata.facts.add("reach", "chebyshev");
  metadata.facts.add("metric", "l1");
  metadata.facts.add("wrap", Value(true));
  metadata.facts.add("form", "scatter");
  metadata.facts.add("source", "mask.png");
  metadata.facts.add("source_channel", 0);
  metadata.facts.add("source_hash", "xxh3-128:0");
  metadata.tiles = {{.motion = {0, -1}, .start_energy = 348180, .energy = 3638, .lower_bound = 3638}};
  metadata.pixel_hash = "xxh3-128:1";
  EXPECT_EQ(
      to_json(metadata),
      R"({"bn_metadata":1,"tool_version":"1.2.3","algorithm":"retarget-exact","algorithm_version":1,)"
      R"("kind":"retarget-tile","recipe":"a = 1\n","seed":7,"step":[48,36],"radius":6,"reach":"chebyshev",)"
      R"("metric":"l1","wrap":true,"form":"scatter","source":"mask.png","source_channel":0,)"
      R"("source_hash":"xxh3-128:0","tiles":[{"motion":[0,-1],"start_energy":348180,"energy":3638,)"
      R"("lower_bound":3638}],"pixel_hash":"xxh3-128:1"})");
}

TEST(Metadata, BrokenJsonIsRefused) {
  const std::string json = to_json(full_metadata());
  for (std::size_t length = 0; length < json.size(); length += length < 600 ? 1 : 37) {
    expect_error(ErrorCode::invalid_input, [&] { metadata_from_json(json.substr(0, length)); });
  }
  for (const auto& [part, by] : {std::pair{"\"bn_metadata\":1", "\"bn_metadata\":2"},
                                 {"\"bn_metadata\":1,", ""},
                                 {"\"seed\":9223372036854775807", "\"seed\":9223372036854775808"},
                                 {"\"form\":\"gather\"", "\"form\":null"},
                                 {"\"form\":\"gather\"", "\"form\":{}"},
                                 {"[49,-37]", "[49,[1]]"},
                                 {"[49,-37]", "[49,0.5]"},
                                 {"\"form\"", "\"Form\""},
                                 {"\"form\"", "\"\""},
                                 {"\"tiles\":[", "\"tiles\":[7,"},
                                 {"\"lower_bound\":4", "\"lower\":4"}}) {
    expect_error(ErrorCode::invalid_input, [&, p = part, b = by] { metadata_from_json(edited(p, b)); });
  }
  // What only some kinds record is kept as it is, and compared by verification; a figure of another type is
  // not taken for one.
  const Facts odd = metadata_from_json(edited("\"radius\":6", "\"radius\":\"6\"")).facts;
  EXPECT_FALSE(odd.get<int>("radius").has_value());
  EXPECT_EQ(odd.get<std::string>("radius"), "6");
  const Facts large = metadata_from_json(edited("\"radius\":6", "\"radius\":2147483648")).facts;
  EXPECT_FALSE(large.get<int>("radius").has_value());
  EXPECT_EQ(large.get<std::int64_t>("radius"), 2147483648);
  std::string many;
  for (int i = 0; i < 65; ++i) many += "\"k" + std::to_string(i) + "\":1,";
  expect_error(ErrorCode::invalid_input, [&] { metadata_from_json(edited("\"form\"", many + "\"form\"")); });
  const std::string deep(1 << 20, '[');
  expect_error(ErrorCode::invalid_input, [&] { metadata_from_json(deep); });
  expect_error(ErrorCode::invalid_input, [&] { metadata_from_json("{\"bn_metadata\":" + deep); });
}

TEST(Metadata, TextThatIsNotUtf8IsRefused) {
  const TemporaryFolder folder;
  Metadata metadata;
  metadata.recipe = "\xff\xfe";
  expect_error(ErrorCode::invalid_input, [&] {
    write_image(folder / "a.png", random_image({2, 2}, 1, SampleType::u8), metadata);
  });
  EXPECT_TRUE(folder.names().empty());
}

TEST(Metadata, LongRecipesSurviveAndTooLongOnesAreRefused) {
  const TemporaryFolder folder;
  Metadata metadata;
  for (int line = 0; line < 2500; ++line)
    metadata.recipe += "key = \"\u00fc " + std::to_string(line) + "\"\n";
  const Image bytes = random_image({4, 4}, 1, SampleType::u8);
  const Image floats = random_image({4, 4}, 1, SampleType::f32);
  for (const char* name : {"a.png", "a.tif", "a.bin", "a.h", "a.exr"}) {
    write_image(folder / name, std::string(name) == "a.exr" ? floats : bytes, metadata);
    const FileContent content = read_image(folder / name);
    ASSERT_TRUE(content.metadata.has_value()) << name << ": " << content.metadata_fault;
    EXPECT_TRUE(content.metadata->recipe == metadata.recipe) << name;
  }
  metadata.recipe.assign(kMaxMetadataBytes - 1000, 'x');
  for (const char* name : {"a.png", "a.bin", "a.h", "a.exr"}) {
    write_image(folder / name, std::string(name) == "a.exr" ? floats : bytes, metadata);
    EXPECT_TRUE(read_image(folder / name).metadata->recipe == metadata.recipe) << name;
  }
  expect_error(ErrorCode::invalid_input, [&] { write_image(folder / "b.tif", bytes, metadata); });
  metadata.recipe.assign(kMaxMetadataBytes, 'x');
  expect_error(ErrorCode::invalid_input, [&] { write_image(folder / "b.png", bytes, metadata); });
}

TEST(Metadata, OthersDescriptionsAreAbsentAndBrokenOnesAreAFault) {
  const auto content_of = [](std::string_view description) {
    FileContent content;
    read_description(description, content);
    EXPECT_FALSE(content.metadata.has_value() && !content.metadata_fault.empty());
    return content;
  };
  for (const char* others : {"", "a photograph", "{\"description\": 1}", "{", "bn_metadata", "null"}) {
    EXPECT_FALSE(content_of(others).metadata.has_value()) << others;
    EXPECT_EQ(content_of(others).metadata_fault, "") << others;
  }
  const std::string json = to_json(full_metadata());
  EXPECT_TRUE(content_of(json).metadata.has_value());
  EXPECT_TRUE(content_of("\n " + json + "\n").metadata.has_value());
  EXPECT_NE(content_of(json.substr(0, json.size() - 1)).metadata_fault, "");
  EXPECT_NE(content_of("{\"bn_metadata\": 2}").metadata_fault, "");
}

TEST(Metadata, ABrokenDescriptionLeavesThePictureReadable) {
  const TemporaryFolder folder;
  const Image image = random_image({5, 3}, 3, SampleType::u8);
  write_image(folder / "a.tif", image, full_metadata());
  std::string bytes = bytes_of(folder / "a.tif");
  bytes[bytes.find("\"algorithm\"") + 1] = 'A';
  put_bytes(folder / "a.tif", bytes);
  const FileContent content = read_image(folder / "a.tif");
  EXPECT_TRUE(same_picture(content.image, image));
  EXPECT_FALSE(content.metadata.has_value());
  EXPECT_NE(content.metadata_fault.find("algorithm"), std::string::npos) << content.metadata_fault;
}

TEST(Metadata, NothingOfTheMachineOrTheTimeIsWritten) {
  const TemporaryFolder folder;
  Metadata metadata;
  const Image bytes = random_image({3, 3}, 3, SampleType::u8);
  write_image(folder / "a.png", bytes, metadata);
  // Exactly these chunks: no tIME, no gAMA (readers that honour it would change the samples).
  std::string chunks;
  const std::string png = bytes_of(folder / "a.png");
  for (std::size_t at = 8; at < png.size();) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(png[at + i]));
    };
    chunks += png.substr(at + 4, 4) + " ";
    at += 12 + (byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3));
  }
  EXPECT_EQ(chunks, "IHDR oFFs tEXt IDAT IEND ");

  write_image(folder / "a.exr", random_image({3, 3}, 3, SampleType::f32), metadata);
  write_image(folder / "a.tif", bytes, metadata);
  std::string host(256, '\0');
  ::gethostname(host.data(), host.size());
  host.resize(std::strlen(host.c_str()));
  for (const char* name : {"a.png", "a.exr", "a.tif"}) {
    const std::string file = bytes_of(folder / name);
    for (const std::string& leak :
         {std::string("OpenImageIO"), std::string("Software"), std::string("HostComputer"), host}) {
      EXPECT_TRUE(leak.size() < 4 || file.find(leak) == std::string::npos) << name << ": " << leak;
    }
  }
  // EXR insists on an attribute for the time; its type, its length 0, and the next attribute follow.
  const std::string exr = bytes_of(folder / "a.exr");
  EXPECT_NE(exr.find(std::string("capDate\0string\0\0\0\0\0channels", 27)), std::string::npos);
}

}  // namespace
}  // namespace bn::texture
