#include "compare/read/reading_process.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include "compare/read/child_answer.hpp"
#include "compare/read/table_bytes.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

// Messages are their length, then their bytes. A partner that is gone is told by the result and by
// no signal.

bool send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool send_message(int socket, std::string_view bytes) {
  const std::size_t size = bytes.size();
  std::array<char, sizeof size> head{};
  std::memcpy(head.data(), &size, sizeof size);
  return send_all(socket, {head.data(), head.size()}) && send_all(socket, bytes);
}

bool receive_all(int socket, char* place, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::recv(socket, place, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    place += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// False where the partner is gone.
bool receive_message(int socket, std::string& bytes) {
  std::size_t size = 0;
  std::array<char, sizeof size> head{};
  if (!receive_all(socket, head.data(), head.size())) return false;
  std::memcpy(&size, head.data(), sizeof size);
  bytes.resize(size);
  return receive_all(socket, bytes.data(), size);
}

std::string request_of(const fs::path& file, const ArrayNames& wanted) {
  Packer out;
  out.put(file.string());
  out.put(wanted.has_value());
  out.put(wanted ? wanted->size() : 0);
  if (wanted)
    for (const std::string& name : *wanted) out.put(name);
  return out.take();
}

std::string table_asked_for(const std::string& request) {
  Unpacker in(request);
  const fs::path file = in.get<std::string>();
  ArrayNames wanted;
  const bool some = in.get<bool>();
  const auto count = in.get<std::size_t>();
  if (some) {
    wanted.emplace();
    for (std::size_t i = 0; i < count; ++i) wanted->push_back(in.get<std::string>());
  }
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  limit_child(failed ? 0 : size);
  Packer out;
  put_table(out, read_vtk_here(file, wanted));
  return out.take();
}

/// Ends where the other side does.
[[noreturn]] void serve(int socket) {
  // It lives long: it must hold nobody's file, and no pipe whose end somebody waits for.
  constexpr int own = 3;
  if (::dup2(socket, own) < 0) _exit(1);
  ::closefrom(own + 1);
  std::string request;
  while (receive_message(own, request))
    if (!send_message(own, answer_of([&] { return table_asked_for(request); }))) break;
  _exit(0);
}

}  // namespace

void ReadingProcess::start() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw Error(asked_.string() + ": no socket to read it by: " + std::strerror(errno));
  std::fflush(nullptr);
  child_ = ::fork();
  if (child_ == 0) serve(ends[1]);
  const int failure = errno;
  ::close(ends[1]);
  socket_ = ends[0];
  if (child_ >= 0) return;
  const fs::path file = asked_;
  end();
  throw Error(file.string() + ": no process to read it by: " + std::strerror(failure));
}

void ReadingProcess::ask(const fs::path& file, const ArrayNames& wanted) {
  // What ended the child before was no fault of this file.
  if (!asked_.empty() && received().empty()) end();
  asked_ = file;
  const std::string request = request_of(file, wanted);
  if (child_ >= 0 && send_message(socket_, request)) return;
  end();
  asked_ = file;
  start();
  (void)send_message(socket_, request);  // answer() finds out where it is gone
}

/// Empty where the child is gone; it stays to be waited for.
std::string ReadingProcess::received() {
  std::string bytes;
  return receive_message(socket_, bytes) ? bytes : std::string();
}

ParticleTable ReadingProcess::answer() {
  std::string bytes = received();
  const fs::path file = std::exchange(asked_, {});
  if (bytes.empty()) {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    end();
    throw broken_down(file, status);
  }
  const std::string result = result_of(std::move(bytes), file);
  Unpacker in(result);
  return get_table(in);
}

void ReadingProcess::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  child_ = -1;
  asked_.clear();
}

}  // namespace surge::compare
