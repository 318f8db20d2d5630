#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/gray_image.h"
#include "base/result.h"

namespace telestrain {

// Whether the bytes of an image file can be what `ReadGrayImage` wants, without decoding them: not
// empty, a known format, the wanted size (with width_px > 0) or at most 100 million pixels, whole,
// one image, as long as its size wants. `name` stands for the file in the message.
Status CheckImageBytes(const std::string& name, std::string_view bytes, int width_px = 0,
                       int height_px = 0);

// Decodes an 8- or 16-bit PNG, TIFF, BMP, PGM or JPEG as grey levels (colour is converted, by
// 0.299 R + 0.587 G + 0.114 B; transparency and the EXIF orientation are left aside). Fails
// (kBadInput) when the file is unreadable, damaged anywhere or, with width_px > 0, when the size is
// not the wanted one; the message names file, found and wanted size, or the byte. Takes the memory
// of the file, its pixels as stored and its pixels as floats.
Result<GrayImage> ReadGrayImage(const std::filesystem::path& path, int width_px = 0,
                                int height_px = 0);

// The same of an image file's bytes; `name` stands for the file in messages.
Result<GrayImage> DecodeGrayImage(const std::string& name, const std::string& bytes,
                                  int width_px = 0, int height_px = 0);

// Keeps OpenCV's functions on the caller's thread, in the whole process: images, not the parts of
// one, are shared among threads. Changes no pixel.
void KeepImagesOnOneThread();

}  // namespace telestrain
