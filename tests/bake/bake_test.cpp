// Protects: a bake makes every file it was asked for, the same bytes with any number of threads; the
// second bake does nothing, a stopped or killed one is completed to the same bytes; errors come
// before work, and a folder has one bake at a time.
#include "fixtures.h"

#include <signal.h>
#include <sys/wait.h>

#include <atomic>
#include <mutex>

#include "bake/folder_lock.h"
#include "bake/manifest.h"

namespace bn {
namespace {

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
}

}  // namespace
}  // namespace bn
