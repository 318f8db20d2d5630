#include "base/files.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

namespace telestrain {
namespace {

std::string Reason(int error_number) { return std::strerror(error_number); }

std::string ToHex(const unsigned char* digest, unsigned size) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * size);
  for (unsigned i = 0; i < size; ++i) {
    hex.push_back(kDigits[digest[i] >> 4]);
    hex.push_back(kDigits[digest[i] & 15]);
  }
  return hex;
}

// An open file descriptor that closes itself.
struct Descriptor {
  int value = -1;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

// `flags`: of open(), beside those for writing. `mode`: of the new file, else what the system makes
// of 0644. Returns 0 or the errno of the first call that failed.
int WriteAndSync(const std::filesystem::path& path, std::string_view bytes, int flags,
                 std::optional<mode_t> mode = std::nullopt) {
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode ? 0600 : 0644)};
  if (file.value < 0) return errno;
  if (mode && ::fchmod(file.value, *mode) != 0) return errno;
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.value, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file.value) == 0 ? 0 : errno;
}

// The permissions of the file that is to be replaced; nothing without one.
std::optional<mode_t> ModeOf(const std::filesystem::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  return facts.st_mode & 0777;
}

Error CannotWrite(const std::filesystem::path& path, int error_number) {
  return OutputFailed(path.string() + ": cannot be written: " + Reason(error_number) +
                      "; free some space or choose another --out folder");
}

}  // namespace

Result<std::string> ReadFile(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return BadInput(path.string() + ": is a folder, a file was expected");
  std::ifstream file(path, std::ios::binary);
  if (!file) return BadInput(path.string() + ": cannot be read: " + Reason(errno));
  // Not by iterators: they let the exception of a failed read through, read() makes it bad().
  std::string bytes;
  std::vector<char> block(1 << 16);
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (file.bad()) return BadInput(path.string() + ": reading failed part-way");
  return bytes;
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  // A killed program of the same number may have left one; a link of that name is not followed.
  ::unlink(temporary.c_str());
  int error_number = WriteAndSync(temporary, bytes, O_EXCL | O_NOFOLLOW, ModeOf(path));
  if (error_number == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return CannotWrite(path, error_number);
}

Status AppendToFile(const std::filesystem::path& path, std::string_view bytes) {
  const int error_number = WriteAndSync(path, bytes, O_APPEND);
  return error_number == 0 ? Status{} : Status{CannotWrite(path, error_number)};
}

Status EnsureFolder(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored))
    return OutputFailed(path.string() + ": cannot be made a folder" +
                        (code ? ": " + code.message() : std::string{}));
  return {};
}

std::string Sha256Hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  const int done =
      EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  TELESTRAIN_CHECK(done == 1, "OpenSSL has no SHA-256");
  return ToHex(digest.data(), size);
}

Result<std::string> Sha256HexOfFile(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  return Sha256Hex(bytes);
}

}  // namespace telestrain
