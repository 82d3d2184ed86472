// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <streambuf>
#include <string>

#include "foothold/base/error.h"

namespace foothold {
namespace {

/// Writes to a file descriptor and remembers the first error, which std::ofstream would forget.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { setp(buffer_.data(), buffer_.data() + buffer_.size()); }
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) {
      *pptr() = traits_type::to_char_type(c);
      pbump(1);
    }
    return traits_type::not_eof(c);
  }
  int sync() override {
    for (const char* begin = pbase(); begin < pptr() && error_ == 0;) {
      const ssize_t written = ::write(descriptor_, begin, static_cast<std::size_t>(pptr() - begin));
      if (written >= 0) {
        begin += written;
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return error_ == 0 ? 0 : -1;
  }

 private:
  int descriptor_;
  int error_ = 0;
  std::array<char, 1U << 16U> buffer_{};
};

[[noreturn]] void throw_write_error(const std::string& path, int error) {
  throw FileError(path + ": cannot be written: " + std::strerror(error));
}

/// Creates a file of a name nobody uses, beside the final one. mkostemp would deny others the right to read.
int create_beside(const std::string& path, std::string& temporary_path) {
  constexpr int kMaxAttempts = 1000;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    temporary_path = path + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    const int descriptor = ::open(temporary_path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace

struct AtomicFile::State {
  std::string path;
  Durability durability = Durability::kPowerCut;
  std::string temporary_path;
  int descriptor = -1;
  std::unique_ptr<DescriptorBuffer> buffer;
  std::unique_ptr<std::ostream> stream;

  ~State() {
    if (descriptor >= 0) ::close(descriptor);
    if (!temporary_path.empty()) ::unlink(temporary_path.c_str());
  }
};

AtomicFile::AtomicFile(const std::string& path, Durability durability) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->durability = durability;
  if (std::filesystem::is_directory(path)) throw FileError(path + ": cannot be written: it is a folder");
  std::string temporary_path;
  state_->descriptor = create_beside(path, temporary_path);
  if (state_->descriptor < 0) throw_write_error(path, errno);
  state_->temporary_path = temporary_path;
  state_->buffer = std::make_unique<DescriptorBuffer>(state_->descriptor);
  state_->stream = std::make_unique<std::ostream>(state_->buffer.get());
}

AtomicFile::~AtomicFile() = default;

std::ostream& AtomicFile::stream() { return *state_->stream; }

void AtomicFile::commit() {
  State& s = *state_;
  s.stream->flush();
  if (s.buffer->error() != 0) throw_write_error(s.path, s.buffer->error());
  if (!*s.stream) throw FileError(s.path + ": cannot be written: the stream was marked as failed");
  if (s.durability == Durability::kPowerCut && ::fsync(s.descriptor) != 0 && errno != EINVAL) {  // EINVAL: nothing to sync, as on a pipe
    throw_write_error(s.path, errno);
  }
  const int closed = ::close(s.descriptor);
  s.descriptor = -1;
  if (closed != 0) throw_write_error(s.path, errno);
  if (std::rename(s.temporary_path.c_str(), s.path.c_str()) != 0) throw_write_error(s.path, errno);
  s.temporary_path.clear();
}

void write_file_atomically(const std::string& path, const std::string& bytes, Durability durability) {
  AtomicFile file(path, durability);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

}  // namespace foothold
