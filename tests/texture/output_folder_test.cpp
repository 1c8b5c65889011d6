// Below a folder of outputs no link is followed.
#include "texture/image/output_folder.h"

#include "texture/image_files.h"

namespace swell::texture {
namespace {

class OutputFolders : public Files {
 protected:
  void SetUp() override {
    Files::SetUp();
    fs::create_directory(folder / "named");
    fs::create_directory(folder / "outside");
    victim_ = put("outside/file", bytes_of("old"));
  }
  std::string victim_content() const {
    const auto bytes = OutputFolder(folder / "outside").read("file").value();
    return {bytes.begin(), bytes.end()};
  }
  fs::path victim_;
};

TEST_F(OutputFolders, HoldWhatWasWritten) {
  const OutputFolder named(folder / "named");
  named.make("");
  named.make("images");
  named.make("images");  // is there
  named.write("a", bytes_of("1"));
  named.write("images/b", bytes_of("2"));
  EXPECT_EQ(named.read("a"), bytes_of("1"));
  EXPECT_EQ(named.read("images/b"), bytes_of("2"));
  EXPECT_EQ(named.names("images"), std::vector<std::string>{"b"});
  EXPECT_EQ(named.read("c"), std::nullopt);
  EXPECT_EQ(named.read("images"), std::nullopt);
  EXPECT_TRUE(named.names("none").empty());
}

TEST_F(OutputFolders, MayBeBehindLinksAndStayTheSame) {
  fs::create_symlink("named", folder / "way");
  const OutputFolder named(folder / "way");
  fs::remove(folder / "way");
  fs::create_symlink("outside", folder / "way");
  named.write("file", bytes_of("new"));
  EXPECT_EQ(OutputFolder(folder / "named").read("file"), bytes_of("new"));
  EXPECT_EQ(victim_content(), "old");
}

TEST_F(OutputFolders, ReplaceALinkAndReadNone) {
  fs::create_directory(folder / "named/images");
  fs::create_symlink("../../outside/file", folder / "named/images/file");
  const OutputFolder named(folder / "named");
  EXPECT_EQ(named.read("images/file"), std::nullopt);
  named.write("images/file", bytes_of("new"));
  EXPECT_EQ(named.read("images/file"), bytes_of("new"));
  EXPECT_EQ(victim_content(), "old");
}

TEST_F(OutputFolders, RefuseALinkInPlaceOfAFolder) {
  fs::create_directory_symlink("../outside", folder / "named/images");
  const OutputFolder named(folder / "named");
  EXPECT_THROW(named.make("images"), FileError);
  EXPECT_THROW(named.write("images/file", bytes_of("new")), FileError);
  EXPECT_EQ(named.read("images/file"), std::nullopt);
  EXPECT_TRUE(named.names("images").empty());
  EXPECT_EQ(victim_content(), "old");
  EXPECT_EQ(named.read("../outside/file"), std::nullopt);
  EXPECT_THROW(named.write("../outside/file", bytes_of("new")), FileError);
  EXPECT_EQ(victim_content(), "old");
  EXPECT_THROW(OutputFolder(folder / "missing"), FileError);
  EXPECT_THROW(OutputFolder{victim_}, FileError);
}

}  // namespace
}  // namespace swell::texture
