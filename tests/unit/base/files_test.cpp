#include "base/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "tests/unit/base/scratch_folder.h"

namespace telestrain {
namespace {

std::ptrdiff_t EntryCount(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(FilesTest, BytesReadBackAsWritten) {
  const ScratchFolder folder("files_bytes");
  std::string bytes;
  for (int i = 0; i < 70000; ++i) bytes += static_cast<char>(i * 7 % 256);
  for (const std::string& content : {bytes, std::string(), std::string("\r\n\0x", 4)}) {
    ASSERT_TRUE(WriteFileAtomically(folder.path() / "f", content).ok());
    EXPECT_EQ(*ReadFile(folder.path() / "f", kMostResultBytes), content);
  }
  EXPECT_EQ(EntryCount(folder.path()), 1) << "a temporary file was left";
}

TEST(FilesTest, AFailedWriteLeavesTheOldFileAndNoTemporary) {
  const ScratchFolder folder("files_failed");
  std::filesystem::create_directories(folder.path() / "target" / "inside");
  const auto status = WriteFileAtomically(folder.path() / "target", "new");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
  EXPECT_NE(status.error().message.find("cannot be written"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "target" / "inside"));
  EXPECT_EQ(EntryCount(folder.path()), 1);
}

TEST(FilesTest, AReplacedFileKeepsItsPermissionsAndNoLinkIsFollowed) {
  namespace fs = std::filesystem;
  const ScratchFolder folder("files_mode");
  const fs::path file = folder.path() / "f", link = folder.path() / "link";
  ASSERT_TRUE(WriteFileAtomically(file, "old").ok());
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_TRUE(WriteFileAtomically(file, "new").ok());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(file, link);
  fs::create_symlink(file, link.string() + ".telestrain-part-" + std::to_string(::getpid()));
  ASSERT_TRUE(WriteFileAtomically(link, "other").ok());
  EXPECT_EQ(*ReadFile(file, kMostResultBytes), "new");
  EXPECT_FALSE(fs::is_symlink(link));
  EXPECT_EQ(EntryCount(folder.path()), 2);
}

TEST(FilesTest, WhatAKilledProgramLeftIsToldFromWhatPeopleName) {
  const ScratchFolder folder("files_left");
  for (const char* name : {"a.json.telestrain-part-99999999", "a.json", "a.telestrain-part-",
                           "a.telestrain-part-99999999b", ".telestrain-part-99999999", "a.part7"})
    ASSERT_TRUE(WriteFileAtomically(folder.path() / name, "x").ok());
  ASSERT_TRUE(RemoveTemporaries(folder.path()).ok());
  EXPECT_EQ(EntryCount(folder.path()), 5);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.json.telestrain-part-99999999"));
}

TEST(FilesTest, WhatAnotherProgramIsWritingStays) {
  const ScratchFolder folder("files_of_others");
  const auto other = folder.path() / ("a.telestrain-part-" + std::to_string(::getppid()));
  const auto own = TemporaryFor(folder.path() / "film.mp4", ".mp4");
  for (const auto& path : {other, own}) std::ofstream(path) << "half";
  EXPECT_TRUE(IsTemporary(own.filename().string()));
  ASSERT_TRUE(RemoveTemporaries(folder.path()).ok());
  EXPECT_TRUE(std::filesystem::exists(other));
  EXPECT_FALSE(std::filesystem::exists(own));
}

TEST(FilesTest, TheRemedyFitsTheReason) {
  for (const auto& [error, remedy] :
       {std::pair{ENOSPC, "free some space"}, std::pair{EDQUOT, "free some space"},
        std::pair{EROFS, "that you may write to"}, std::pair{EACCES, "that you may write to"},
        std::pair{EIO, "look after it"}, std::pair{EFBIG, "ulimit -f"},
        std::pair{ENOENT, "make the folder first"}, std::pair{ENAMETOOLONG, "shorter name"}}) {
    const Error said = CannotWrite("f", error);
    EXPECT_EQ(said.kind, ErrorKind::kOutputFailed);
    EXPECT_TRUE(said.message.starts_with(std::string("f: cannot be written: ") +
                                         std::strerror(error) + "; "))
        << said.message;
    EXPECT_NE(said.message.find(remedy), std::string::npos) << said.message;
  }
}

TEST(FilesTest, WritingIntoNoFolderFails) {
  const ScratchFolder folder("files_nowhere");
  EXPECT_FALSE(WriteFileAtomically(folder.path() / "no" / "f", "x").ok());
}

TEST(FilesTest, ReadingNamesPathAndReason) {
  const ScratchFolder folder("files_reading");
  const auto missing = ReadFile(folder.path() / "missing", kMostResultBytes);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(missing.error().message.find("missing: cannot be read: No such file"),
            std::string::npos)
      << missing.error().message;
  const auto is_folder = ReadFile(folder.path(), kMostResultBytes);
  ASSERT_FALSE(is_folder.ok());
  EXPECT_NE(is_folder.error().message.find("is a folder"), std::string::npos);
}

TEST(FilesTest, BadPathsAndFailedReadsAreBadInput) {
  const ScratchFolder folder("files_bad");
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  // The first page of a process' own memory is a file that opens and cannot be read.
  for (const auto& path : {folder.path() / std::string(5000, 'x'), folder.path() / "loop",
                           std::filesystem::path("/proc/self/mem")}) {
    const auto bytes = ReadFile(path, kMostResultBytes);
    ASSERT_FALSE(bytes.ok()) << path;
    EXPECT_EQ(bytes.error().kind, ErrorKind::kBadInput);
  }
}

TEST(FilesTest, NeverWaitsForAPipeAndNeverReadsADevice) {
  const ScratchFolder folder("files_pipe");
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& [path, kind] : {std::pair{pipe, "is a named pipe"},
                                   std::pair{std::filesystem::path("/dev/zero"), "is a device"}})
    for (const auto& error :
         {ReadFile(path, kMostResultBytes).error(), Sha256HexOfFile(path).error()}) {
      EXPECT_EQ(error.kind, ErrorKind::kBadInput);
      EXPECT_NE(error.message.find(kind), std::string::npos) << error.message;
      EXPECT_NE(error.message.find("; give a regular file"), std::string::npos) << error.message;
    }
}

TEST(FilesTest, ALimitIsReachedButNotPassed) {
  const ScratchFolder folder("files_limit");
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "f", "abcd").ok());
  EXPECT_EQ(*ReadFile(folder.path() / "f", 4), "abcd");
  const auto larger = ReadFile(folder.path() / "f", 3);
  ASSERT_FALSE(larger.ok());
  EXPECT_NE(larger.error().message.find("has 4 bytes or more, the limit is 3; "), std::string::npos)
      << larger.error().message;
  // The system states no size of this one, which is longer.
  EXPECT_FALSE(ReadFile("/proc/self/maps", 10).ok());
}

TEST(FilesTest, EnsureFolderMakesParentsAndMayBeRepeated) {
  const ScratchFolder folder("files_ensure");
  EXPECT_TRUE(EnsureFolder(folder.path() / "a" / "b").ok());
  EXPECT_TRUE(EnsureFolder(folder.path() / "a" / "b").ok());
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "file", "x").ok());
  for (const auto& path : {folder.path() / "file", folder.path() / "file" / "below"}) {
    const auto status = EnsureFolder(path);
    ASSERT_FALSE(status.ok()) << path;
    EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
  }
}

TEST(Sha256Test, GivesThePublishedDigests) {
  // FIPS 180-4 examples and the empty message.
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256Test, OfAFileIsThatOfItsBytes) {
  const ScratchFolder folder("files_sha");
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "f", "abc").ok());
  EXPECT_EQ(*Sha256HexOfFile(folder.path() / "f"), Sha256Hex("abc"));
  EXPECT_FALSE(Sha256HexOfFile(folder.path() / "g").ok());
}

}  // namespace
}  // namespace telestrain
