#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>

#include "base/descriptor.h"
#include "base/files.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

std::string ToHex(const unsigned char* digest, unsigned size) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  hex.reserve(std::size_t{2} * size);
  for (unsigned i = 0; i < size; ++i) {
    hex.push_back(kDigits[digest[i] >> 4]);
    hex.push_back(kDigits[digest[i] & 15]);
  }
  return hex;
}

// Gets one piece of a file after the other.
using TakePiece = std::function<void(const char* bytes, std::size_t count)>;

// What a file that is none is, for people.
const char* KindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a named pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string RemedyOf(int error_number) {
  if (error_number == ENOENT || error_number == ENOTDIR) return "; correct the path";
  if (error_number == EACCES || error_number == EPERM) return "; allow reading it";
  if (error_number == ELOOP) return "; give the file itself instead of the link";
  if (error_number == ENAMETOOLONG) return "; give a shorter path";
  if (error_number == EMFILE || error_number == ENFILE)
    return "; allow more open files (ulimit -n) or end other programs";
  if (error_number == ENOMEM) return "; allow more memory (ulimit -v) or end other programs";
  return "; copy the file to another place and give that one";
}

Error NotRegular(const std::string& name, const char* kind) {
  return BadInput(name + ": is " + kind + ", a file was expected; give a regular file");
}

Error TooLarge(const std::string& name, std::size_t bytes, std::size_t most_bytes) {
  return BadInput(name + ": has " + std::to_string(bytes) + " bytes or more, the limit is " +
                  std::to_string(most_bytes) + "; give the file that is meant here");
}

// Reads to the end, or to one byte beyond the limit: a file may grow, and some state no size.
Status ReadPieces(const std::filesystem::path& path, std::size_t most_bytes,
                  const std::function<void(std::size_t)>& reserve, const TakePiece& take) {
  const std::string name = PrintableText(path.string());
  // O_NONBLOCK: opening a named pipe must not wait for a writer.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
  // A socket cannot be opened at all.
  if (file.value < 0 && errno == ENXIO) return NotRegular(name, "a socket or device");
  if (file.value < 0)
    return BadInput(name + ": cannot be read: " + std::strerror(errno) + RemedyOf(errno));
  struct stat facts {};
  if (::fstat(file.value, &facts) != 0)
    return BadInput(name + ": cannot be read: " + std::strerror(errno) + RemedyOf(errno));
  if (!S_ISREG(facts.st_mode)) return NotRegular(name, KindOf(facts.st_mode));
  const auto size = static_cast<std::size_t>(facts.st_size);
  if (size > most_bytes) return TooLarge(name, size, most_bytes);
  reserve(size);
  std::array<char, kPieceBytes> piece;
  for (std::size_t done = 0;;) {
    const ssize_t count = ::read(file.value, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return BadInput(name + ": reading failed after " + std::to_string(done) +
                      " bytes: " + std::strerror(errno) + RemedyOf(errno));
    if (count == 0) return {};
    done += static_cast<std::size_t>(count);
    if (done > most_bytes) return TooLarge(name, done, most_bytes);
    take(piece.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

Result<std::string> ReadFile(const std::filesystem::path& path, std::size_t most_bytes) {
  std::string bytes;
  TELESTRAIN_RETURN_IF_ERROR(ReadPieces(
      path, most_bytes, [&](std::size_t size) { bytes.reserve(size); },
      [&](const char* piece, std::size_t count) { bytes.append(piece, count); }));
  return bytes;
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
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  bool done = EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  TELESTRAIN_RETURN_IF_ERROR(ReadPieces(
      path, kAnySize, [](std::size_t) {},
      [&](const char* piece, std::size_t count) {
        done = done && EVP_DigestUpdate(context.get(), piece, count) == 1;
      }));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  done = done && EVP_DigestFinal_ex(context.get(), digest.data(), &size) == 1;
  TELESTRAIN_CHECK(done, "OpenSSL has no SHA-256");
  return ToHex(digest.data(), size);
}

}  // namespace telestrain
