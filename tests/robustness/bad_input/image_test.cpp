// Images that are cut short, damaged, of another kind or lie about their size.
#include <gtest/gtest.h>
#include <zlib.h>

#include <opencv2/imgcodecs.hpp>

#include "robustness/bad_input/damaged_folder.h"
#include "target/image_file.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

cv::Mat Noise(int width_px, int height_px, int type = CV_8U) {
  cv::Mat pixels(height_px, width_px, type);
  cv::setRNGSeed(7);
  cv::randu(pixels, 0, 255);
  return pixels;
}

std::string Encoded(const std::string& extension, const cv::Mat& pixels) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, pixels, bytes);
  return {bytes.begin(), bytes.end()};
}

// Empty when it was taken, else why not; nothing may be written beside.
std::string Refusal(const std::string& bytes) {
  ::testing::internal::CaptureStderr();
  const auto image = DecodeGrayImage("dir/image", bytes);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  if (image) return "";
  EXPECT_EQ(image.error().kind, ErrorKind::kBadInput);
  EXPECT_EQ(FaultOfMessage(image.error().message, "dir/image"), "") << image.error().message;
  return image.error().message;
}

void ExpectRefused(const std::string& bytes, const std::string& words) {
  EXPECT_NE(Refusal(bytes).find(words), std::string::npos) << words << ": " << Refusal(bytes);
}

std::string BigEndian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string Chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body +
         BigEndian(static_cast<std::uint32_t>(sum));
}

std::string Deflated(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string packed(size, '\0');
  ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
              reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 9);
  packed.resize(size);
  return packed;
}

// `kind`: depth and colour type; `more`: chunks before the pixels; `rows`: not yet packed.
std::string Png(std::uint32_t width_px, std::uint32_t height_px, const std::string& rows,
                const std::string& kind = std::string("\x08\0", 2), const std::string& more = "") {
  return "\x89PNG\r\n\x1A\n" +
         Chunk("IHDR", BigEndian(width_px) + BigEndian(height_px) + kind + std::string(3, '\0')) +
         more + Chunk("IDAT", Deflated(rows)) + Chunk("IEND", "");
}

TEST(DamagedImage, CutShortAnywhereIsNeverTaken) {
  for (const std::string extension : {".png", ".jpg", ".tif", ".bmp", ".pgm"})
    for (const Damaged& damage : Truncations(Encoded(extension, Noise(40, 30)), 60))
      EXPECT_NE(Refusal(damage.bytes), "") << extension << " " << damage.what;
}

TEST(DamagedImage, WithAByteChangedIsTakenOrRefusedQuietly) {
  for (const std::string extension : {".png", ".jpg", ".tif", ".bmp", ".pgm"})
    for (const Damaged& damage : Flips(Encoded(extension, Noise(40, 30)), 120)) {
      SCOPED_TRACE(extension + " " + damage.what);
      Refusal(damage.bytes);
    }
}

TEST(DamagedImage, DamageIsToldByItsByte) {
  std::string png = Encoded(".png", Noise(40, 30)), jpeg = Encoded(".jpg", Noise(40, 30));
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 1);
  ExpectRefused(png, "is damaged, byte ");
  const std::size_t scan = jpeg.find("\xFF\xDA");
  jpeg.erase(scan + 200, 300);
  ExpectRefused(jpeg, "is damaged, byte ");
}

TEST(DamagedImage, SizesThatTheFileCannotHold) {
  const std::string rows(1000, '\0');
  ExpectRefused(Png(60000, 60000, rows), "more than the limit of 100 million pixels");
  ExpectRefused(Png(9999, 9999, rows), "too few for the 9999 x 9999 px");
  ExpectRefused(Png(0, 10, rows), "does not begin like an image");
  ExpectRefused("P5\n9999 9999\n255\n" + rows, "too few for the 9999 x 9999 px");
  ExpectRefused("P2\n9999 9999\n255\n1 2 3", "too few for the 9999 x 9999 px");
  std::string bmp = Encoded(".bmp", Noise(40, 30)), tiff = Encoded(".tif", Noise(40, 30));
  bmp.replace(18, 8, std::string("\x0f\x27\0\0\x0f\x27\0\0", 8));
  ExpectRefused(bmp, "too few for the 9999 x 9999 px");
}

// A marker without a length hides the real frame from who takes the next bytes for one.
TEST(DamagedImage, AJpegOfTwoSizes) {
  const std::string real = Encoded(".jpg", Noise(40, 30)).substr(2);
  constexpr std::size_t kJump = 4 + 0xFFE0;  // over the "length" FF E0
  std::string jpeg = "\xFF\xD8\xFF\x01" + real;
  jpeg.resize(kJump, '\0');
  jpeg += std::string("\xFF\xC0\0\x11\x08\0\x0c\0\x10\3", 10) + std::string(9, '\1') + "\xFF\xD9";
  ExpectRefused(jpeg, "a second size, 40 x 30 px");
}

// The width of one would stand elsewhere, and all of the other.
TEST(DamagedImage, ATiffWhoseSizeStandsElsewhere) {
  const std::string tiff = Encoded(".tif", Noise(40, 30));
  ASSERT_EQ(tiff.substr(0, 4), std::string("II*\0", 4));
  const std::size_t width = tiff.find(std::string("\0\1\3\0\1\0\0\0\x28", 9));
  ASSERT_NE(width, std::string::npos);
  std::string long8 = tiff, big = tiff;
  long8[width + 2] = 16;
  big[2] = 43;
  for (const std::string& bytes : {long8, big})
    ExpectRefused(bytes, "does not begin like an image");
}

TEST(DamagedImage, TextsOfAPngThatUnpackToGigabytesAreNotKept) {
  std::string rows, texts;
  const cv::Mat pixels = Noise(40, 30);
  for (int y = 0; y < 30; ++y)
    rows += std::string(1, '\0') + std::string(reinterpret_cast<const char*>(pixels.ptr(y)), 40);
  const std::string text =
      Chunk("zTXt", std::string("a\0\0", 3) + Deflated(std::string(7900000, ' ')));
  for (int i = 0; i < 100; ++i) texts += text;
  EXPECT_EQ(Refusal(Png(40, 30, rows, std::string("\x08\0", 2), texts)), "");
}

TEST(DamagedImage, OfAnotherKind) {
  const std::string rows(31 * 200, '\0');
  ExpectRefused(Png(40, 30, rows, std::string("\x08\0", 2), Chunk("acTL", std::string(8, '\1'))),
                "is an animation");
  ExpectRefused(Png(40, 30, rows, std::string("\x03\0", 2)), "is damaged, byte ");
  ExpectRefused(Png(40, 30, rows, std::string("\x08\5", 2)), "is damaged, byte ");
  ExpectRefused("GIF89a" + rows, "does not begin like an image");
  ExpectRefused("", "is empty");
  const ScratchFolder scratch("telestrain_bad_image_");
  const std::filesystem::path pages = scratch.path() / "pages.tif";
  ASSERT_TRUE(cv::imwritemulti(pages.string(), std::vector<cv::Mat>{Noise(40, 30), Noise(40, 30)}));
  ExpectRefused(ReadAll(pages), "is one of several in the file");
  ExpectRefused(Encoded(".tif", Noise(40, 30, CV_32F)), "32 bit a pixel");
}

TEST(DamagedImage, KindsOfPixelsThatCamerasGiveAreTaken) {
  const cv::Mat gray = Noise(40, 30);
  for (const int type : {CV_8U, CV_16U, CV_8UC3, CV_16UC3, CV_8UC4, CV_16UC4})
    for (const std::string extension : {".png", ".tif"})
      EXPECT_EQ(Refusal(Encoded(extension, Noise(40, 30, type))), "") << extension << type;
  // A grey image with transparency, interlaced rows and a palette.
  EXPECT_EQ(Refusal(Png(40, 30, std::string(30 * 81, '\0'), std::string("\x08\4", 2))), "");
  const auto with_alpha = DecodeGrayImage("a", Encoded(".png", Noise(40, 30, CV_8UC4)));
  const auto without = DecodeGrayImage("a", Encoded(".bmp", Noise(40, 30, CV_8UC3)));
  EXPECT_TRUE(with_alpha.ok() && without.ok());
}

// The pixels of our decoders are OpenCV's to the bit: results do not depend on who decoded.
TEST(DamagedImage, DecodersAgreeWithOpenCv) {
  for (const int type : {CV_8U, CV_8UC3})
    for (const std::string extension : {".png", ".jpg"}) {
      const std::string bytes = Encoded(extension, Noise(61, 43, type));
      cv::Mat wanted =
          cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
      wanted.convertTo(wanted, CV_32F);
      if (type == CV_8UC3) {
        cv::Mat gray(wanted.size(), CV_32F);
        for (int y = 0; y < wanted.rows; ++y)
          for (int x = 0; x < wanted.cols; ++x) {
            const auto& bgr = wanted.at<cv::Vec3f>(y, x);
            gray.at<float>(y, x) = 0.114F * bgr[0] + 0.587F * bgr[1] + 0.299F * bgr[2];
          }
        wanted = gray;
      }
      const auto image = DecodeGrayImage("image", bytes);
      ASSERT_TRUE(image.ok()) << image.error().message;
      for (int y = 0; y < 43; ++y)  // 1e-4: sums of three products of floats below 256
        for (int x = 0; x < 61; ++x)
          ASSERT_NEAR(image->At(x, y), wanted.at<float>(y, x), type == CV_8U ? 0 : 1e-4)
              << extension;
    }
}

}  // namespace
}  // namespace telestrain::testing_support
