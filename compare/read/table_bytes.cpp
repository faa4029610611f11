#include "compare/read/table_bytes.hpp"

namespace surge::compare {

void put_table(Packer& out, const ParticleTable& table) {
  out.put(table.count);
  out.put(table.points);
  out.put(table.arrays.size());
  for (const ParticleArray& array : table.arrays) {
    out.put(array.name);
    out.put(array.components);
    out.put(array.type);
    out.put(array.values);
    out.put(array.words.size());
    for (const std::string& word : array.words) out.put(word);
  }
  put_optional(out, table.time);
  out.put(table.notes.size());
  for (const std::string& note : table.notes) out.put(note);
}

ParticleTable get_table(Unpacker& in) {
  ParticleTable table;
  table.count = in.get<std::size_t>();
  table.points = in.get<std::vector<double>>();
  table.arrays.resize(in.get<std::size_t>());
  for (ParticleArray& array : table.arrays) {
    array.name = in.get<std::string>();
    array.components = in.get<int>();
    array.type = in.get<std::string>();
    array.values = in.get<std::vector<double>>();
    array.words.resize(in.get<std::size_t>());
    for (std::string& word : array.words) word = in.get<std::string>();
  }
  table.time = get_optional<double>(in);
  table.notes.resize(in.get<std::size_t>());
  for (std::string& note : table.notes) note = in.get<std::string>();
  return table;
}

}  // namespace surge::compare
