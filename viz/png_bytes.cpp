#include "viz/png_bytes.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "viz/image_data.h"
#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

// CRC-32 of PNG (ISO/IEC 15948, annex D), bit by bit: it runs over 13 bytes.
std::uint32_t Crc(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xedb88320U ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

// Pixels per metre in both directions (ISO/IEC 15948, 11.3.5.3; unit 1 is the metre).
std::string PhysChunk(int dots_per_inch) {
  const auto px_per_m = static_cast<std::uint32_t>(std::lround(dots_per_inch / 0.0254));
  const std::string body = "pHYs" + BigEndian(px_per_m) + BigEndian(px_per_m) + '\x01';
  return BigEndian(static_cast<std::uint32_t>(body.size() - 4)) + body + BigEndian(Crc(body));
}

}  // namespace

Result<std::string> PngBytes(const RgbImage& image) {
  VtkMessages messages;
  vtkNew<vtkImageData> data;
  FillImageData(image, data);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(6);
  writer->Write();
  const vtkUnsignedCharArray* result = writer->GetResult();
  if (result == nullptr || result->GetNumberOfValues() == 0)
    return OutputFailed("pictures: PNG encoding failed: " + messages.FirstError());
  vtkUnsignedCharArray* bytes = writer->GetResult();
  std::string png(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                  static_cast<std::size_t>(bytes->GetNumberOfValues()));
  constexpr std::size_t kEndOfHeader = 8 + 25;  // signature and IHDR, which always comes first
  png.insert(kEndOfHeader, PhysChunk(image.dots_per_inch));
  return png;
}

}  // namespace telestrain::viz
