#pragma once

#include <filesystem>
#include <string>

namespace telestrain {

// A small session folder on disk, as another program would write it, for tests that change one
// thing and look at what the reader says. Lives below testing::TempDir() as long as the object.
class SampleFolder {
 public:
  explicit SampleFolder(const std::string& name);
  ~SampleFolder();
  SampleFolder(const SampleFolder&) = delete;
  SampleFolder& operator=(const SampleFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void Write(const std::string& file, const std::string& text) const;
  std::string Read(const std::string& file) const;
  void Remove(const std::string& file) const;
  // Replaces the only occurrence of `from`; throws when it is not there exactly once.
  void Replace(const std::string& file, const std::string& from, const std::string& to) const;
  // 1-based line of the first occurrence of `text`; throws when there is none.
  int LineOf(const std::string& file, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace telestrain
