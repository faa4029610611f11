#include "particle/io/checkpoint.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "particle/io/atomic_file.hpp"
#include "particle/io/case_difference.hpp"
#include "particle/io/run_folder.hpp"
#include "particle/io/run_size.hpp"
#include "particle/io/source_hash.hpp"
#include "particle/support/json.hpp"
#include "particle/support/version.hpp"

namespace surge {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view magic = "surge-particle checkpoint, format 1\n";
constexpr double longest_header = 64e6;  ///< bytes; a case with its tables takes less
constexpr std::size_t sum_bytes = 15;    ///< "crc32 01234567\n"
constexpr const char* anew = "; --force starts anew";

using Sum = uLong;

Sum add_to_sum(Sum sum, const void* data, std::size_t bytes) {
  return crc32_z(sum, static_cast<const Bytef*>(data), bytes);
}

std::string sum_text(Sum sum) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "crc32 %08lx\n", sum);
  return text.data();
}

/// zlib takes no more than 32 bits of a length in some versions; the disk gets as much at a time.
constexpr std::size_t portion = std::size_t{1} << 24U;

/// A file with its checksum.
class SummedFile {
 public:
  explicit SummedFile(fs::path file) : file_(std::move(file)) {}
  void write(std::span<const std::byte> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(portion, bytes.size()))) {
      const auto part = bytes.first(std::min(portion, bytes.size()));
      sum_ = add_to_sum(sum_, part.data(), part.size());
      file_.write(part);
    }
  }
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  void commit() {
    file_.write(sum_text(sum_));
    file_.commit(true);
  }

 private:
  AtomicFile file_;
  Sum sum_ = crc32_z(0, nullptr, 0);
};

json fields_json(std::span<const StateField> state) {
  json fields = json::array();
  for (const StateField& field : state)
    fields.push_back({field.name, field.type, field.count, field.value_bytes});
  return fields;
}

}  // namespace

void write_checkpoint(const fs::path& folder, const Computation& computation,
                      const RunRecord& record, std::span<const StateField> state) {
  const BuildInfo build = build_info();
  const json header{{"build", source_hash()}, {"compiler", build.compiler},
                    {"flags", build.flags},   {"case", to_toml(computation)},
                    {"run", to_json(record)}, {"fields", fields_json(state)}};
  const std::string text = header.dump() + '\n';
  SummedFile file(folder / checkpoint_name);
  file.write(magic);
  file.write(std::to_string(text.size()) + '\n');
  file.write(text);
  for (const StateField& field : state) file.write(std::span(field.data, field.bytes()));
  file.commit();
}

void require_checkpoint(const fs::path& folder) {
  std::error_code code;
  const fs::path file = folder / checkpoint_name;
  if (fs::exists(fs::symlink_status(file, code))) return;
  throw RestartError(file.string() +
                     ": found no checkpoint, expected one to go on from (a run that is finished or "
                     "has not begun has none)");
}

void remove_checkpoint(const fs::path& folder) {
  std::error_code ignored;  // one that stays leads to the same end again
  fs::remove(folder / checkpoint_name, ignored);
}

Checkpoint::Checkpoint(const fs::path& folder, const Computation& computation)
    : file_(folder / checkpoint_name) {
  open(longest_header + 2.0 * run_size(computation).memory);
  check_sum();
  try {
    const json header = read_header();
    check_build(header);
    check_case(header, computation);
    record_ = run_record(header.at("run"));
    read_fields(header);
  } catch (const json::exception&) {
    refuse("found a header that is none, expected that of a checkpoint");
  }
}

void Checkpoint::refuse(const std::string& reason) const {
  throw RestartError(file_.string() + ": " + reason + anew);
}

void Checkpoint::open(double most_bytes) {
  std::error_code code;
  const fs::file_status status = fs::symlink_status(file_, code);
  if (!fs::is_regular_file(status)) refuse("found no file of its own, expected a checkpoint");
  const std::uintmax_t bytes = fs::file_size(file_, code);
  if (code) refuse("found " + code.message() + ", expected a readable checkpoint");
  if (static_cast<double>(bytes) > most_bytes)
    refuse("found " + bytes_text(static_cast<double>(bytes)) + ", expected at most " +
           bytes_text(most_bytes) + " for this case");
  if (bytes < magic.size() + sum_bytes) refuse("found a cut file, expected a whole checkpoint");
  size_ = static_cast<std::size_t>(bytes) - sum_bytes;
  stream_.open(file_, std::ios::binary);
  if (!stream_) refuse("found no way to read it, expected a readable checkpoint");
}

void Checkpoint::check_sum() {
  std::vector<char> part(portion);
  Sum sum = crc32_z(0, nullptr, 0);
  for (std::size_t left = size_; left > 0;) {
    const std::size_t count = std::min(left, part.size());
    stream_.read(part.data(), static_cast<std::streamsize>(count));
    if (!stream_) refuse("found no way to read it, expected a readable checkpoint");
    if (left == size_ && !std::string_view(part.data(), count).starts_with(magic))
      refuse("found another kind of file, expected a checkpoint of format 1");
    sum = add_to_sum(sum, part.data(), count);
    left -= count;
  }
  std::string stored(sum_bytes, '\0');
  stream_.read(stored.data(), static_cast<std::streamsize>(stored.size()));
  if (!stream_ || stored != sum_text(sum))
    refuse("found a checksum that is not that of the content, expected an undamaged checkpoint");
}

json Checkpoint::read_header() {
  stream_.seekg(static_cast<std::streamoff>(magic.size()));
  std::size_t length = 0;
  stream_ >> length;
  const bool newline = stream_.get() == '\n';
  if (!stream_ || !newline || length > size_)
    refuse("found a header that is none, expected that of a checkpoint");
  std::string text(length, '\0');
  stream_.read(text.data(), static_cast<std::streamsize>(length));
  try {
    return parse_json(text, file_.string());
  } catch (const Error&) {
    refuse("found a header that is none, expected that of a checkpoint");
  }
}

void Checkpoint::check_build(const json& header) const {
  const BuildInfo build = build_info();
  const auto check = [&](const char* what, const std::string& found, const std::string& expected) {
    if (found == expected) return;
    refuse(std::string("found a checkpoint of another build, ") + what + ' ' + found.substr(0, 80) +
           ", expected " + expected);
  };
  check("of sources", header.at("build").get<std::string>().substr(0, 12),
        std::string(source_hash().substr(0, 12)));
  check("by", header.at("compiler").get<std::string>(), build.compiler);
  check("with", header.at("flags").get<std::string>(), build.flags);
}

void Checkpoint::check_case(const json& header, const Computation& computation) const {
  const auto difference =
      case_difference(header.at("case").get<std::string>(), to_toml(computation));
  if (!difference) return;
  refuse("found a checkpoint of another case: " + difference->key + " = " + difference->first +
         ", expected " + difference->second);
}

void Checkpoint::read_fields(const json& header) {
  std::vector<StateField> fields;
  double bytes = 0.0;
  for (const json& entry : header.at("fields")) {
    if (!entry.at(2).is_number_unsigned() || !entry.at(3).is_number_unsigned())
      refuse("found a field without a size, expected its number of values");
    StateField field{entry.at(0), entry.at(1), entry.at(2), entry.at(3), false, nullptr};
    bytes += static_cast<double>(field.count) * static_cast<double>(field.value_bytes);
    fields.push_back(std::move(field));
  }
  const auto there = static_cast<double>(size_) - static_cast<double>(stream_.tellg());
  if (bytes != there)
    refuse("found " + number_text(there) + " bytes of state, expected " + number_text(bytes));
  state_.emplace(stream_, std::move(fields), file_);
}

}  // namespace surge
