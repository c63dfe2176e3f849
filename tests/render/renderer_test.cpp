// Protects: the two renderers are one (lavapipe equals the processor bit for bit, every method, every
// shipped scene, silent validation layers); light transport is right where the answer is known; the
// multiset of seeds survives; what cannot be rendered is refused by name.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "bn/error.h"
#include "bn/random.h"
#include "bn_study/measures.h"
#include "render/test_textures.h"

namespace bn {
namespace {

std::shared_ptr<VulkanDevice> device() {
  static const auto device = open_vulkan_device("lavapipe", true);
  return device;
}

/// Textures with motion variants whose tiles are cheap: each a shift by its motion.
const TemporalTextures& shifting_textures() {
  static const TemporalTextures textures = [] {
    TemporalTextures made{.masks = {test::mask_64()}, .step = test::kStep, .motion_range = 2};
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) made.moves.emplace_back(Extent{64, 64}, Offset{x, y});
    }
    return made;
  }();
  return textures;
}

std::size_t different(const Grid<Rgb>& a, const Grid<Rgb>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    using Bits = std::array<std::uint32_t, 3>;
    count += std::bit_cast<Bits>(a[i]) != std::bit_cast<Bits>(b[i]);
  }
  return count;
}

void expect_same(const Scene& scene, const RenderSettings& settings, int frames,
                 const TemporalTextures& textures = shifting_textures()) {
  SCOPED_TRACE(scene.name + ", " + std::string(name_of(settings.method)));
  const auto plain = make_plain_renderer(scene, textures, settings);
  const auto vulkan = make_vulkan_renderer(device(), scene, textures, settings);
  for (int frame = 0; frame < frames; ++frame) {
    const Frame a = plain->next();
    const Frame b = vulkan->next();
    ASSERT_EQ(a.seeds, b.seeds) << "frame " << frame;
    ASSERT_EQ(a.motion, b.motion) << "frame " << frame;
    ASSERT_EQ(different(a.colour, b.colour), 0u) << "frame " << frame;
    ASSERT_EQ(a.shown, b.shown) << "frame " << frame;
    ASSERT_EQ(a.motion_of_pixel, b.motion_of_pixel) << "frame " << frame;
  }
  EXPECT_TRUE(complaints(*device()).empty()) << complaints(*device()).front();
}

TEST(Renderer, LavapipeEqualsTheProcessorInEveryMethod) {
  for (const Method method : kMethods) {
    expect_same(load_scene("room"),
                {.screen = {67, 45}, .method = method, .bounces = 3, .block = 4, .jitter = true}, 3);
  }
}

/// Three masks of 16 bits on a small tile, no multiple of the screen, each with a shift for every motion.
TemporalTextures small_stack() {
  TemporalTextures stack{.masks = {}, .step = {1, 2}, .motion_range = 1};
  for (std::uint32_t z = 0; z < 3; ++z) {
    Grid<std::int32_t>& levels = stack.masks.emplace_back(Extent{24, 16});
    for (std::size_t i = 0; i < levels.count(); ++i)
      levels[i] = static_cast<std::int32_t>(random_bits(9, z, i) & 65535);
    for (int i = 0; i < 9; ++i)
      stack.moves.emplace_back(Extent{24, 16}, Offset{i % 3 - 1 + static_cast<int>(z), i / 3 - 1});
  }
  return stack;
}

TEST(Renderer, LavapipeEqualsTheProcessorOnAStack) {
  for (const Method method : {Method::mask_moved, Method::retarget, Method::reproject}) {
    expect_same(load_scene("slow-pan"), {.screen = {67, 45}, .method = method, .block = 4}, 7, small_stack());
  }
}

TEST(Renderer, LavapipeEqualsTheProcessorInEveryScene) {
  for (const std::string& scene : shipped_scene_names()) {
    expect_same(load_scene(scene),
                {.screen = {64, 40}, .method = Method::reproject, .block = 2, .sort_by_light = true}, 3);
  }
}

TEST(Renderer, LavapipeEqualsTheProcessorWithManyPaths) {
  expect_same(load_scene("room"), {.screen = {40, 24}, .method = Method::white, .paths = 5}, 2);
}

/// A wall of four texels, lit evenly: red and green above, blue and white below.
Scene picture_scene() {
  Scene scene = read_scene(R"(
    name = "picture"
    sky = [1, 1, 1]
    fov_degrees = 28
    camera = [{eye = [0, 0, 4], at = [0, 0, 0]}]
    material = [{name = "image"}]
    quad = [{corner = [-1, -1, 0], edge_u = [2, 0, 0], edge_v = [0, 2, 0], material = "image"}]
  )",
                           "picture");
  scene.images.emplace_back(Extent{2, 2});
  scene.images[0](0, 0) = {1, 0, 0};
  scene.images[0](1, 0) = {0, 1, 0};
  scene.images[0](0, 1) = {0, 0, 1};
  scene.images[0](1, 1) = {1, 1, 1};
  scene.materials[0].image = 0;
  return scene;
}

TEST(Renderer, AnImageStandsUpright) {
  const auto renderer =
      make_plain_renderer(picture_scene(), shifting_textures(), {.screen = {32, 32}, .bounces = 1});
  const Frame frame = renderer->next();
  const auto shows = [&](int x, int y, float r, float g, float b) {
    const Rgb colour = frame.colour(x, y);
    EXPECT_NEAR(colour.r, r, 1e-5) << x << ", " << y;
    EXPECT_NEAR(colour.g, g, 1e-5) << x << ", " << y;
    EXPECT_NEAR(colour.b, b, 1e-5) << x << ", " << y;
  };
  // An evenly lit reflectance is as bright as itself times the sky.
  shows(4, 4, 1, 0, 0);
  shows(15, 15, 1, 0, 0);
  shows(16, 15, 0, 1, 0);
  shows(4, 28, 0, 0, 1);
  shows(16, 16, 1, 1, 1);
  shows(28, 28, 1, 1, 1);
}

TEST(Renderer, LavapipeEqualsTheProcessorOnAnImage) {
  expect_same(picture_scene(), {.screen = {33, 31}, .method = Method::retarget}, 3);
}

TEST(Renderer, APanIsSeenAsItsMotion) {
  // The camera goes right by 1.25 pixels a frame, so the picture goes left by as much.
  const auto renderer = make_plain_renderer(load_scene("slow-pan"), shifting_textures(),
                                            {.screen = {96, 64}, .method = Method::reproject});
  EXPECT_EQ(renderer->next().motion, (Offset{0, 0}));
  EXPECT_EQ(renderer->next().motion, (Offset{-1, 0}));
}

/// The mean radiance of a picture, over many frames of white noise.
// The flat scene, rendered: what remains at frame 8 is what the flat model says (flat_model_test.cpp).
TEST(Renderer, TheFlatSceneReachesTheFiguresOfTheModel) {
  const auto frame_8 = [](Method method, int block) {
    const auto renderer =
        make_vulkan_renderer(device(), load_scene("wall"), test::proven_textures(),
                             {.screen = {256, 256}, .method = method, .bounces = 1, .block = block});
    for (int frame = 0; frame < 8; ++frame) renderer->next();
    const Grid<Rgb> colour = renderer->next().colour;
    Grid<float> shown(colour.size());
    for (std::size_t i = 0; i < shown.count(); ++i) shown[i] = colour[i].r;  // all is grey
    return 10.0 * std::log10(low_frequency_power(shown, 0.1));
  };
  EXPECT_NEAR(frame_8(Method::sort, 8), -3.4, 1.0);
  EXPECT_LE(frame_8(Method::retarget, 2), -9.0);
  EXPECT_LE(frame_8(Method::retarget, 8), -17.0);
  EXPECT_LE(frame_8(Method::retarget, 16), -19.5);
}

double mean_radiance(const Scene& scene, int bounces, int frames) {
  const auto renderer = make_plain_renderer(
      scene, shifting_textures(), {.screen = {32, 32}, .method = Method::white, .bounces = bounces});
  double sum = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    for (const Rgb& colour : renderer->next().colour) sum += colour.r;
  }
  return sum / (frames * 32.0 * 32.0);
}

TEST(LightTransport, FurnaceOfAlbedoOneIsAsBrightAsItsSky) {
  // A white sphere under an even sky returns all the light it gets, at every bounce.
  const Scene scene = read_scene(R"(
    name = "furnace"
    sky = [0.5, 0.5, 0.5]
    camera = [{eye = [0, 0, 4], at = [0, 0, 0]}]
    material = [{name = "white", albedo = [1, 1, 1]}]
    sphere = [{centre = [0, 0, 0], radius = 1, material = "white"}]
  )",
                                 "furnace");
  EXPECT_NEAR(mean_radiance(scene, 4, 4), 0.5, 1e-5);
}

TEST(LightTransport, GlossyFurnaceLosesOnlyWhatMaskingLoses) {
  const Scene scene = read_scene(R"(
    name = "furnace"
    sky = [0.5, 0.5, 0.5]
    camera = [{eye = [0, 0, 4], at = [0, 0, 0]}]
    material = [{name = "mirror", albedo = [1, 1, 1], roughness = 0.3}]
    sphere = [{centre = [0, 0, 0], radius = 1, material = "mirror"}]
  )",
                                 "furnace");
  // Single scattering at alpha 0.09 keeps all but about one part in a hundred; never gains.
  const double mean = mean_radiance(scene, 1, 40);
  EXPECT_LT(mean, 0.501);
  EXPECT_GT(mean, 0.485);
}

TEST(LightTransport, WallUnderALightMeetsTheClosedForm) {
  // The differential form factor of a parallel square above its centre: with half side h and distance
  // d, E = 4 L x / (2 s) * 2 atan(x / s), x = h, s = sqrt(h^2 + d^2), twice; radiance = albedo E / pi.
  const Scene scene = read_scene(R"(
    name = "patch"
    fov_degrees = 1
    camera = [{eye = [0, 0.4, 1.9], at = [0, 0, 0]}]
    material = [{name = "grey", albedo = [0.5, 0.5, 0.5]},
                {name = "light", albedo = [0, 0, 0], emission = [3, 3, 3]}]
    quad = [{corner = [-4, -4, 0], edge_u = [8, 0, 0], edge_v = [0, 8, 0], material = "grey"},
            {corner = [-1, -1, 2], edge_u = [2, 0, 0], edge_v = [0, 2, 0], material = "light"}]
  )",
                                 "patch");
  const double s = std::sqrt(1.0 + 4.0);
  const double irradiance = 3.0 * 4.0 / s * std::atan(1.0 / s);
  EXPECT_NEAR(mean_radiance(scene, 1, 60), 0.5 / 3.14159265358979 * irradiance, 0.002);
}

TEST(Scenes, MistakesAreNamedWithTheirLine) {
  const auto message = [](const std::string& toml) -> std::string {
    try {
      read_scene(toml, "scene.toml");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      return error.what();
    }
    return "";
  };
  const std::string camera = "name = 'x'\n[[camera]]\neye = [0, 0, 4]\nat = [0, 0, 0]\n";
  const std::string material = "[[material]]\nname = 'm'\n";
  const auto expect = [&](const std::string& toml, const std::string& part) {
    EXPECT_NE(message(toml).find(part), std::string::npos)
        << "'" << message(toml) << "' lacks '" << part << "'";
  };
  expect("nmae = 'x'", "scene.toml:1: unknown key 'nmae'");
  expect("name = ", "scene.toml:1");
  expect(camera, "0 primitives");
  expect(camera, "scene.toml, scene x");
  expect("about = '" + std::string(501, 'a') + "'\n" + camera, "501 bytes");
  expect(camera + material + "[[sphere]]\ncentre = [0, nan, 0]\nradius = 1\nmaterial = 'm'", "scene.toml:8");
  expect(camera + material + "[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nmaterial = 'n'", "no material 'n'");
  expect(camera + material + "[[sphere]]\ncentre = [0, 0, 0]\nradius = -1\nmaterial = 'm'", "radius");
  expect(camera + material +
             "[[quad]]\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [1, 1, 0]\nmaterial = 'm'",
         "right angles");
  EXPECT_THROW(load_scene("no-such-scene"), Error);
  // Names become file names.
  expect("name = '../x'\n[[camera]]\neye = [0, 0, 4]\nat = [0, 0, 0]\n", "the name '../x'");
  expect(camera + "[[region]]\nname = 'a,b'\n", "the name 'a,b'");
  expect(camera + "[[region]]\nname = 'picture'\n", "'picture'");
  try {
    read_scene(camera + "[[material]]\nname = 'm'\nimage = 'nowhere.png'\n", "scene.toml");
    ADD_FAILURE() << "an image that is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io);
    EXPECT_NE(std::string(error.what()).find("scene.toml:7: nowhere.png"), std::string::npos) << error.what();
  }
}

TEST(Renderer, WrongSettingsAreRefused) {
  const Scene scene = load_scene("wall");
  const auto refused = [&](const TemporalTextures& textures, const RenderSettings& settings) {
    try {
      make_plain_renderer(scene, textures, settings);
    } catch (const Error& error) {
      return error.code() == ErrorCode::invalid_input;
    }
    return false;
  };
  EXPECT_TRUE(refused(shifting_textures(), {.screen = {0, 4}}));
  EXPECT_TRUE(refused(shifting_textures(), {.screen = {8, 5000}}));
  EXPECT_TRUE(refused(shifting_textures(), {.bounces = 9}));
  EXPECT_TRUE(refused(shifting_textures(), {.block = 5}));
  EXPECT_TRUE(refused(shifting_textures(), {.paths = 0}));
  EXPECT_TRUE(refused({.masks = {test::mask_64()}, .step = {1, 1}}, {.method = Method::retarget}));
  EXPECT_TRUE(refused({.masks = {test::mask_64()}, .step = {1, 1}},
                      {.method = {Sampler::mask_still, SeedTransport::sort}}))
      << "seeds that nobody samples";
}

}  // namespace
}  // namespace bn
