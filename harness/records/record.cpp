#include "harness/records/record.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/files/whole_file.h"

namespace cutbench {

namespace {

std::string joined(const std::vector<std::string>& fields, std::size_t n) {
  std::string line;
  for (std::size_t i = 0; i < n; ++i) line += (i ? "," : "") + fields[i];
  return line;
}

std::string key_of(const std::string& line, std::size_t columns) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < columns && end != std::string::npos; ++i) end = line.find(',', end + (i > 0));
  return line.substr(0, end);
}

}  // namespace

Record::Record(const std::vector<std::string>& columns) : columns_(&columns), fields_(columns.size()) {}

Record::Record(const std::vector<std::string>& columns, const std::string& line) : Record(columns) {
  std::size_t begin = 0;
  for (std::string& field : fields_) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    field = line.substr(begin, end - begin);
    begin = std::min(end + 1, line.size());
  }
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t end; (end = line.find(',', begin)) != std::string::npos; begin = end + 1)
    fields.push_back(line.substr(begin, end - begin));
  fields.push_back(line.substr(begin));
  return fields;
}

std::size_t Record::index(const std::string& column) const {
  return to_size(std::find(columns_->begin(), columns_->end(), column) - columns_->begin());
}

const std::string& Record::get(const std::string& column) const { return fields_.at(index(column)); }

void Record::set(const std::string& column, const std::string& value) {
  const std::size_t i = index(column);
  fields_.at(i) = value;
  // Free text must not break the line into more fields.
  for (char& c : fields_[i])
    if (c == ',' || c == '"' || c == '\n') c = ';';
}

void Record::set(const std::string& column, double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  set(column, std::string(buffer, end));
}

void Record::set(const std::string& column, std::int64_t value) { set(column, std::to_string(value)); }

std::string Record::key(std::size_t columns) const { return joined(fields_, columns); }
std::string Record::line() const { return joined(fields_, fields_.size()); }

namespace {

/// What rows of any shard share, and which shard these are: the last line of the identity, "i/N".
struct Identity {
  std::string all;
  int shard = 1, shards = 1;

  explicit Identity(const std::string& identity) : all(identity.substr(0, identity.rfind('\n'))) {
    const std::size_t line = identity.rfind('\n');
    if (line == std::string::npos) return;
    [[maybe_unused]] const int found = std::sscanf(identity.c_str() + line, "%d/%d", &shard, &shards);
    assert(found == 2);
  }
  std::string number() const { return std::to_string(std::hash<std::string>{}(all)); }
};

}  // namespace

RecordFile::RecordFile(const std::filesystem::path& folder, const std::string& identity,
                       const std::vector<std::string>& columns, std::size_t keys)
    : folder_(folder), part_(folder_ / "records.csv.part"), columns_(columns), identity_(identity), keys_(keys) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw InputError(folder_.string() + ": can't be made (" + error.message() + "); choose another --out");
  check_writable(part_, "--out");
  const std::string head = "# run " + std::to_string(std::hash<std::string>{}(identity)) + '\n';
  const bool another_run = resume(head);
  if (done_.empty()) {
    out_.open(part_, std::ios::trunc);
    out_ << head;
  } else {
    out_.open(part_, std::ios::app);
    note_ = "resumed, " + std::to_string(done_.size()) + " rows were there";
  }
  if (another_run) note_ = part_.string() + " is of another program, experiment or shard: started anew";
  check();
}

/// Takes what a run with this head left, and cuts off what was being written when it was killed. True where the rows
/// there are of another run.
bool RecordFile::resume(const std::string& head) {
  std::ifstream in(part_, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  in.close();
  if (!text.starts_with(head)) return text.find('\n') != std::string::npos;
  std::size_t begin = head.size();
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    if (to_size(std::count(line.begin(), line.end(), ',')) + 1 != columns_.size()) break;
    lines_.push_back(line);
    done_.insert(key_of(line, keys_));
  }
  std::error_code ignored;  // if it can't be cut, nor can it be appended to
  std::filesystem::resize_file(part_, begin, ignored);
  return false;
}

void RecordFile::check() {
  errno = 0;
  out_.flush();
  if (!out_)
    throw OutputError(part_.string() + ": can't be written" +
                      (errno ? std::string(" (") + std::strerror(errno) + ")" : "") +
                      "; make room and run the same command again to go on");
}

void RecordFile::append(const Record& record) {
  lines_.push_back(record.line());
  out_ << lines_.back() << '\n';
  check();
}

void RecordFile::finish(const Context& context, const std::string& experiment, const std::string& claim,
                        const std::string& command, std::uint64_t seed) {
  const Identity run(identity_);
  const nlohmann::json document{{"commit", context.commit ? nlohmann::json(*context.commit) : nlohmann::json()},
                                {"dirty", context.dirty ? nlohmann::json(*context.dirty) : nlohmann::json()},
                                {"compiler", context.compiler},
                                {"flags", context.flags},
                                {"build_type", context.build_type},
                                {"cpu", context.cpu},
                                {"versions", context.versions},
                                {"date", context.date},
                                {"load", context.load},
                                {"seed", seed},
                                {"command", command},
                                {"experiment", experiment},
                                {"claim", claim},
                                {"run", run.number()},
                                {"shard", run.shard},
                                {"shards", run.shards},
                                {"rows", lines_.size()}};
  std::string csv = joined(columns_, columns_.size()) + '\n';
  for (const auto& line : lines_) csv += line + '\n';
  WholeFile context_file(folder_ / "context.json", document.dump(2) + '\n');
  WholeFile records(folder_ / "records.csv", csv);
  context_file.place();
  records.place();
  out_.close();
  std::filesystem::remove(part_);
}

}  // namespace cutbench
