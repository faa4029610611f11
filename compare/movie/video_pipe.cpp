#include "compare/movie/video_pipe.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

/// Writes to a pipe whose reader may be gone: that is an error of write(), not the program's end.
class WithoutBrokenPipe {
 public:
  WithoutBrokenPipe() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, &before_);
  }
  WithoutBrokenPipe(const WithoutBrokenPipe&) = delete;
  WithoutBrokenPipe& operator=(const WithoutBrokenPipe&) = delete;
  ~WithoutBrokenPipe() { sigaction(SIGPIPE, &before_, nullptr); }

 private:
  struct sigaction before_ {};
};

std::vector<std::string> words_of(const fs::path& unfinished, const std::string& kind,
                                  std::size_t width, std::size_t height, int pictures) {
  std::vector<std::string> words{"ffmpeg",
                                 "-nostdin",
                                 "-hide_banner",
                                 "-loglevel",
                                 "error",
                                 "-f",
                                 "rawvideo",
                                 "-pix_fmt",
                                 "rgb24",
                                 "-s",
                                 std::to_string(width) + "x" + std::to_string(height),
                                 "-r",
                                 std::to_string(pictures),
                                 "-i",
                                 "pipe:0",
                                 "-an"};
  const std::vector<std::string> mp4{"-c:v",     "libx264", "-crf",      "20",
                                     "-pix_fmt", "yuv420p", "-movflags", "+faststart",
                                     "-threads", "2",       "-f",        "mp4"};
  const std::vector<std::string> gif{"-vf",
                                     "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]"
                                     "paletteuse=dither=none:diff_mode=rectangle",
                                     "-f", "gif"};
  const auto& how = kind == ".gif" ? gif : mp4;
  words.insert(words.end(), how.begin(), how.end());
  words.insert(words.end(), {"-y", "file:" + fs::absolute(unfinished).string()});
  return words;
}

}  // namespace

VideoPipe::VideoPipe(const fs::path& out, std::size_t width, std::size_t height, int pictures)
    : out_(out), unfinished_(out.string() + ".part") {
  const std::string kind = out.extension().string();
  if (kind != ".mp4" && kind != ".gif")
    throw Error(out.string() + ": found the ending \"" + kind + "\", expected .mp4 or .gif");
  const fs::path folder = fs::absolute(out).parent_path();
  if (!fs::is_directory(folder)) throw Error(folder.string() + ": there is no such folder");
  std::array<int, 2> in{}, said{};
  if (pipe2(in.data(), O_CLOEXEC) != 0)
    throw Error("ffmpeg: no pipe: " + std::string(strerror(errno)));
  if (pipe2(said.data(), O_CLOEXEC) != 0) {
    close(in[0]);
    close(in[1]);
    throw Error("ffmpeg: no pipe: " + std::string(strerror(errno)));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, said[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, said[1], STDERR_FILENO);
  std::vector<std::string> words = words_of(unfinished_, kind, width, height, pictures);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int failure = posix_spawnp(&child_, "ffmpeg", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(in[0]);
  close(said[1]);
  to_ = in[1];
  from_ = said[0];
  if (failure == 0) return;
  child_ = 0;
  static_cast<void>(end());
  throw Error(failure == ENOENT
                  ? std::string("ffmpeg: not found, expected the program (Debian package ffmpeg)")
                  : "ffmpeg: " + std::string(strerror(failure)));
}

VideoPipe::~VideoPipe() {
  if (to_ < 0) return;
  if (child_ != 0) kill(child_, SIGKILL);
  static_cast<void>(end());
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

void VideoPipe::add(std::span<const std::uint8_t> picture) {
  const WithoutBrokenPipe guard;
  while (!picture.empty()) {
    const ssize_t count = write(to_, picture.data(), picture.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const std::string said = end();
      std::error_code ignored;
      fs::remove(unfinished_, ignored);
      throw Error(out_.string() + ": ffmpeg ended early: " + said);
    }
    picture = picture.subspan(static_cast<std::size_t>(count));
  }
}

std::string VideoPipe::end() {
  close(to_);
  to_ = -1;
  std::string text;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t count = read(from_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  close(from_);
  if (child_ == 0) return text;
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = 0;
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return good ? "" : text.empty() ? "it failed" : text;
}

void VideoPipe::finish() {
  const std::string said = end();
  std::error_code ignored;
  if (!said.empty()) {
    fs::remove(unfinished_, ignored);
    throw Error(out_.string() + ": ffmpeg failed: " + said);
  }
  fs::rename(unfinished_, out_);
}

}  // namespace surge::compare
