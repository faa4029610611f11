#include <algorithm>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

std::string bytes_between(const fs::path& file, std::uintmax_t begin, std::uintmax_t end) {
  const std::uintmax_t size = fs::file_size(file);
  const std::uintmax_t last = end == 0 ? size : std::min(end, size);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string() + ": cannot be opened");
  std::string text(last > begin ? last - begin : 0, '\0');
  in.seekg(static_cast<std::streamoff>(begin));
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(in.gcount()) != text.size())
    throw Error(file.string() + ": ends while it is read");
  return text;
}

FileLines::FileLines(const fs::path& file, std::uintmax_t begin, std::uintmax_t end)
    : file_(file), in_(file, std::ios::binary), at_(begin), read_(begin), end_(end) {
  if (!in_) throw Error(file.string() + ": cannot be opened");
  if (end_ == 0) end_ = fs::file_size(file);
  in_.seekg(static_cast<std::streamoff>(begin));
}

bool FileLines::next(std::string_view& line) {
  constexpr std::size_t block = 1 << 20;
  std::size_t stop = buffer_.find('\n', used_);
  while (stop == std::string::npos && read_ < end_) {
    if (buffer_.size() - used_ > 4 * block)
      throw Error(file_.string() + ": a line of more than 4 MiB, a table of particles expected");
    buffer_.erase(0, used_);
    used_ = 0;
    const std::size_t old = buffer_.size();
    const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(block, end_ - read_));
    buffer_.resize(old + wanted);
    in_.read(buffer_.data() + old, static_cast<std::streamsize>(wanted));
    if (static_cast<std::size_t>(in_.gcount()) != wanted)
      throw Error(file_.string() + ": ends while it is read");
    read_ += wanted;
    stop = buffer_.find('\n', old);
  }
  open_end_ = stop == std::string::npos;
  if (open_end_ && used_ == buffer_.size()) {
    open_end_ = last_open_;
    return false;
  }
  if (open_end_) stop = buffer_.size();
  last_open_ = open_end_;
  line = std::string_view(buffer_).substr(used_, stop - used_);
  at_ += stop - used_ + (open_end_ ? 0 : 1);
  used_ = stop + (open_end_ ? 0 : 1);
  return true;
}

bool Lines::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = text_.find('\n', at_);
  const bool last = end == std::string_view::npos;
  line = text_.substr(at_, last ? end : end - at_);
  at_ = last ? text_.size() : end + 1;
  return true;
}

}  // namespace surge::compare
