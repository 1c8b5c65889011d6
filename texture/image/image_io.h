// Image files. The one door to OpenImageIO, which is loaded with the first image that is decoded,
// or encoded as anything but PNG (texture/image/image_codec.h; throws std::runtime_error if there
// is no room for it), and to libpng. Reads PNG, EXR, HDR, TIFF and PNM (by name and by content) and
// nothing else; writes PNG, EXR and TIFF to memory first and then to a new file that gets the name
// when it is done, so that a file is whole or not there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "texture/image/image.h"
#include "texture/image/image_note.h"

namespace swell::texture {

// What is wrong with a file; what() names the file, what was found and what is allowed, one line.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ReadLimits {
  int max_side_px = 16384;
  std::uint64_t max_bytes = 512ull << 20;  // of the decoded image as float
};

// Reads an image as float: 8 and 16-bit integers as [0, 1], floats as stored, and the 32-bit
// integers of EXR as the numbers that they are. Refuses integers of 32 bits or with a sign in other
// formats, those of EXR that a float does not hold (2^24 + 1 is the first), and 64-bit floats; more
// than 4 channels, sizes over the limits (before allocating), NaN and infinite pixels (naming one),
// and whatever is not a regular file. Channels come as stored: alpha is not multiplied in.
ImageF read_image(const std::filesystem::path& path, const ReadLimits& limits = {});

// The longer side of a PNG file by its first bytes, `limit` at most; `limit` for what is no PNG
// file or cannot be read.
int side_at_most_px(const std::filesystem::path& path, int limit);

// Whether a file of this name holds floats as they are, and no integers of [0, 1]: EXR and HDR.
bool holds_floats(const std::filesystem::path& path);

// Encodes by the file name's extension: .png (8 or 16-bit), .exr (float), .tif/.tiff (float, 8 or
// 16-bit).
// Channels are written as they are: display-encoded bytes stay display-encoded, alpha is not
// divided out. EXR channels are named Y, YA, RGB or RGBA unless names are given (then any number
// of channels is allowed). The same image gives the same bytes: no dates. Throws FileError for
// other extensions.
std::vector<std::uint8_t> encode_image(const Image8& image, const std::string& extension,
                                       const ImageExtras& extras = {});
std::vector<std::uint8_t> encode_image(const Image16& image, const std::string& extension);
std::vector<std::uint8_t> encode_image(const ImageF& image, const std::string& extension,
                                       std::span<const std::string> channel_names = {},
                                       const ImageExtras& extras = {});

// Writes bytes to a new file in the folder of `path`, syncs it and gives it the name. On any
// failure throws FileError and leaves the old file and no other one. A symbolic link of this name
// is replaced, not followed; devices, pipes, folders and links to them are refused. It has the mode
// of the one that it replaces, and its owner and group where the system allows it (else its group
// may do no more than others might); access lists are not kept. Other hard links to the old file
// keep the old content: only so is the file whole at any time. Until it is whole the file has no
// name (O_TMPFILE), where the file system has such files; else, and for the moment of replacing, it
// is .swell-HOST-BOOT-PID-N.tmp. Several threads may write.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// For the signal handler of a program that is to end: removes what write_file() has under temporary
// names, on any thread, and waits for a replacement that is going on. No other begins. Safe in
// handlers; call it once.
void abandon_writes() noexcept;

// Removes the temporary files in `folder` of processes that were killed in write_file(): of this
// host alone (its name, machine id and process ids), and only where the process is surely dead. A
// folder that cannot be read is left as it is.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace swell::texture
