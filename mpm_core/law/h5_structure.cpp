#include "law/h5_structure.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace granulaw::h5 {

namespace {

using Address = std::uint64_t;
using Bytes = std::string_view;

constexpr std::uint64_t most_bytes = 128u << 20;  // every pair of 30 materials takes 54 MB
constexpr Address undefined = ~Address{0};
constexpr int most_depth = 16, most_levels = 8;
constexpr std::uint64_t leaf_k = 4, internal_k = 16;  // libhdf5's defaults, in the superblock
constexpr std::uint64_t most_rank = 8, most_values = 32u << 20, most_value_bytes = 65536;

/// Message types of an object header (specification, IV.A.2).
enum class Message : unsigned {
  nothing = 0x0,
  dataspace = 0x1,
  datatype = 0x3,
  old_fill_value = 0x4,
  fill_value = 0x5,
  layout = 0x8,
  attribute = 0xc,
  continuation = 0x10,
  symbol_table = 0x11,
  modification_time = 0x12,
};

/// A piece of the file: a message's body, a block of messages.
struct Part
{
  Address at;
  std::uint64_t size;
};

/// Addresses of a group's entries and of their names.
struct SymbolTable
{
  Address tree, heap;
  bool operator==(const SymbolTable&) const = default;
};

class Walk
{
 public:
  Walk(const std::string& path, Bytes file) : path_(path), file_(file) {}
  void file();

 private:
  void require(bool ok, const char* what, Address at) const
  {
    if (!ok)
      fail(path_, fmt::format("is damaged or cut off, or not stored as a law file is: {}{} at byte {}",
                              object_.empty() ? "" : place() + ", ", what, at));
  }
  /// Names may be many and long: the end of the path says most.
  std::string place() const
  {
    constexpr std::size_t most = 80;
    return object_.size() <= most ? fmt::format("'{}'", object_)
                                  : fmt::format("'...{}'", object_.substr(object_.size() - most));
  }
  /// `size` bytes from `at`.
  Bytes bytes(Address at, std::uint64_t size) const
  {
    require(at <= file_.size() && size <= file_.size() - at, "a part beyond the end", at);
    return file_.substr(at, size);
  }
  /// Little-endian, `width` bytes.
  std::uint64_t number(Address at, unsigned width) const
  {
    const Bytes raw = bytes(at, width);
    std::uint64_t value = 0;
    for (unsigned k = width; k-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[k]);
    return value;
  }
  /// Takes a part for one owner: nothing is in two places, so no walk goes in a circle.
  void claim(Part part);

  std::optional<SymbolTable> object(Address at);
  std::map<Message, Part> messages(Address at);
  void dataset(const Part& type, const Part& space, const Part& layout);
  void attribute(const Part& part) const;
  void fill_value(const Part& part) const;
  std::uint64_t value_bytes(const Part& type) const;
  std::uint64_t value_count(const Part& space) const;

  void group(const SymbolTable& table, int depth);
  Part heap(Address at);
  std::string name(const Part& heap, std::uint64_t offset) const;
  void tree(Address at, std::uint64_t level, const Part& names, int depth);
  void leaf(Address at, const Part& names, int depth);
  void entry(Address at, const Part& names, int depth);

  const std::string& path_;
  Bytes file_;
  std::map<Address, Address> claimed_;  // begin -> end
  std::string object_;                  // path of the object at work, for messages
};

void Walk::claim(Part part)
{
  bytes(part.at, part.size);
  const Address end = part.at + part.size;
  const auto next = claimed_.lower_bound(part.at);
  require((next == claimed_.end() || next->first >= end) &&
              (next == claimed_.begin() || std::prev(next)->second <= part.at),
          "a part that belongs to two owners", part.at);
  if (part.size > 0) claimed_[part.at] = end;
}

/// Superblock and root group (II.A).
void Walk::file()
{
  require(bytes(0, 8) == Bytes("\x89HDF\r\n\x1a\n", 8), "no signature of HDF5", 0);
  require(number(8, 5) == 0, "another version of the superblock", 8);
  require(number(13, 3) == 0x0808, "addresses or lengths that are not of 8 bytes", 13);
  require(number(16, 2) == leaf_k && number(18, 2) == internal_k, "an unusual size of groups", 16);
  require(number(20, 4) == 0, "flags of a file that is still being written", 20);
  require(number(24, 8) == 0 && number(32, 8) == undefined && number(48, 8) == undefined,
          "a base address, a table of free space or a driver", 24);
  const Address end = number(40, 8);
  require(end >= 96 && end <= file_.size(), "an end that is cut off", 40);
  file_ = file_.substr(0, end);
  claim({0, 96});
  const std::uint64_t cached = number(72, 4);
  require(number(56, 8) == 0 && cached <= 1, "a root with a name, or that is a link", 56);
  const std::optional<SymbolTable> root = object(number(64, 8));
  require(root.has_value(), "a root that is no group", 64);
  require(cached == 0 || SymbolTable{number(80, 8), number(88, 8)} == *root, "a second account of a group",
          80);
  group(*root, 0);
}

/// An object (IV.A): what its messages say; of a group, where its entries are.
std::optional<SymbolTable> Walk::object(Address at)
{
  const std::map<Message, Part> all = messages(at);
  const auto has = [&](Message type) { return all.contains(type); };
  if (has(Message::symbol_table)) {
    require(!has(Message::dataspace) && !has(Message::datatype) && !has(Message::layout),
            "a group that is a dataset as well", at);
    const Part table = all.at(Message::symbol_table);
    require(table.size >= 16, "a message that is cut off", table.at);
    return SymbolTable{number(table.at, 8), number(table.at + 8, 8)};
  }
  require(has(Message::dataspace) && has(Message::datatype) && has(Message::layout),
          "what is neither a group nor a dataset", at);
  dataset(all.at(Message::datatype), all.at(Message::dataspace), all.at(Message::layout));
  return {};
}

/// The messages of an object header (IV.A.1.a) that come once; the others are checked on the way.
std::map<Message, Part> Walk::messages(Address at)
{
  claim({at, 16});
  require(number(at, 1) == 1, "another version of an object header", at);
  require(number(at + 4, 4) == 1, "an object with several names", at);
  std::vector<Part> blocks = {{at + 16, number(at + 8, 4)}};
  std::map<Message, Part> all;
  std::uint64_t count = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Part block = blocks[b];
    claim(block);
    for (Address next = block.at; next < block.at + block.size; ++count) {
      require(block.at + block.size - next >= 8, "a message that is cut off", next);
      const auto type = static_cast<Message>(number(next, 2));
      const Part body{next + 8, number(next + 2, 2)};
      require(body.size % 8 == 0 && body.size <= block.at + block.size - body.at, "a message that is cut off",
              next);
      require(number(next + 4, 1) <= 1, "a message that is shared", next);  // 1: constant
      switch (type) {
        case Message::nothing:
          break;
        case Message::attribute:
          attribute(body);
          break;
        case Message::continuation:
          require(body.size >= 16, "a message that is cut off", next);
          blocks.push_back({number(body.at, 8), number(body.at + 8, 8)});
          break;
        case Message::fill_value:
        case Message::old_fill_value:
        case Message::modification_time:
        case Message::dataspace:
        case Message::datatype:
        case Message::layout:
        case Message::symbol_table:
          require(all.emplace(type, body).second, "a message that comes twice", next);
          break;
        default:
          require(false, "links, filters, or other things that a law file has not", next);
      }
      next = body.at + body.size;
    }
  }
  require(count == number(at + 2, 2), "a wrong number of messages", at);
  for (const Message type : {Message::fill_value, Message::old_fill_value})
    if (const auto found = all.find(type); found != all.end()) fill_value(found->second);
  if (const auto time = all.find(Message::modification_time); time != all.end())
    require(time->second.size >= 8 && number(time->second.at, 4) == 1, "an unusable time", time->second.at);
  return all;
}

/// Address of a dataset's values (IV.A.2.i, version 3).
void Walk::dataset(const Part& type, const Part& space, const Part& layout)
{
  const std::uint64_t size = value_bytes(type) * value_count(space);
  const Address at = layout.at;
  require(layout.size >= 8 && number(at, 1) == 3, "another version of the layout", at);
  const std::uint64_t kind = number(at + 1, 1);
  require(kind <= 1, "values that are not stored plain", at);
  if (kind == 0) {
    const std::uint64_t stored = number(at + 2, 2);
    require(stored == size && stored <= layout.size - 4, "values of another size than declared", at);
    return;
  }
  require(layout.size >= 18, "a message that is cut off", at);
  const Part values{number(at + 2, 8), number(at + 10, 8)};
  require(values.size == size, "values of another size than declared", at);
  if (values.at != undefined) claim(values);  // undefined: never written
}

/// An attribute (IV.A.2.m, versions 1 and 3): name, type, extent and value in one message.
void Walk::attribute(const Part& part) const
{
  require(part.size >= 16, "a message that is cut off", part.at);
  const std::uint64_t version = number(part.at, 1);
  require((version == 1 || version == 3) && (version == 1 || number(part.at + 1, 1) == 0),
          "another version of an attribute", part.at);
  require(version == 1 || number(part.at + 8, 1) <= 1, "an unknown alphabet", part.at);
  const auto padded = [&](std::uint64_t size) { return version == 1 ? (size + 7) / 8 * 8 : size; };
  Part left{part.at + (version == 1 ? 8 : 9), part.size - (version == 1 ? 8 : 9)};
  const auto take = [&](std::uint64_t size) {
    require(padded(size) <= left.size, "an attribute that is cut off", part.at);
    const Part taken{left.at, size};
    left = {left.at + padded(size), left.size - padded(size)};
    return taken;
  };
  const Part name = take(number(part.at + 2, 2)), type = take(number(part.at + 4, 2)),
             space = take(number(part.at + 6, 2));
  require(name.size > 1 && bytes(name.at, name.size).find('\0') == name.size - 1, "an unusable name",
          name.at);
  require(value_bytes(type) * value_count(space) <= left.size, "an attribute that is cut off", part.at);
}

/// A fill value (IV.A.2.e and f): its length only; the reader never sees one.
void Walk::fill_value(const Part& part) const
{
  const bool old = number(part.at - 8, 2) == static_cast<unsigned>(Message::old_fill_value);
  require(part.size >= 8, "a message that is cut off", part.at);
  if (old) {
    require(number(part.at, 4) <= part.size - 4, "a message that is cut off", part.at);
    return;
  }
  require(number(part.at, 1) == 2 && number(part.at + 1, 1) <= 3 && number(part.at + 2, 1) <= 2 &&
              number(part.at + 3, 1) <= 1,
          "an unusable fill value", part.at);
  require(number(part.at + 3, 1) == 0 || number(part.at + 4, 4) <= part.size - 8, "a message that is cut off",
          part.at);
}

/// Bytes of one value of a type (IV.A.2.d): integers, IEEE floats and texts of fixed length.
std::uint64_t Walk::value_bytes(const Part& type) const
{
  require(type.size >= 8, "a message that is cut off", type.at);
  const std::uint64_t kind = number(type.at, 1), flags = number(type.at + 1, 3),
                      size = number(type.at + 4, 4);
  require(size > 0 && size <= most_value_bytes, "a type of unusable size", type.at);
  const char* other = "a type that a law file has not";
  if (kind == 0x13) {
    require((flags & 0xf) <= 2 && flags >> 4 <= 1, other, type.at);
    return size;
  }
  require(kind == 0x10 || kind == 0x11, other, type.at);
  require(type.size >= (kind == 0x10 ? 12u : 20u), "a message that is cut off", type.at);
  // byte order and sign vary; every bit of the value is significant
  if (kind == 0x10) {
    require((size == 1 || size == 2 || size == 4 || size == 8) && (flags & ~0x9u) == 0 &&
                number(type.at + 8, 4) == (size * 8) << 16,
            other, type.at);
    return size;
  }
  const bool wide = size == 8;
  require((wide || size == 4) && (flags & ~1u) == (wide ? 0x3f20u : 0x1f20u) &&
              number(type.at + 8, 8) == (wide ? 0x34000b3400400000u : 0x1700081700200000u) &&
              number(type.at + 16, 4) == (wide ? 1023u : 127u),
          other, type.at);
  return size;
}

/// Number of values (IV.A.2.b, version 1).
std::uint64_t Walk::value_count(const Part& space) const
{
  require(space.size >= 8 && number(space.at, 1) == 1, "another version of an extent", space.at);
  const std::uint64_t rank = number(space.at + 1, 1), flags = number(space.at + 2, 1);
  require(rank <= most_rank && flags <= 1, "an unusable rank", space.at);
  require(8 + 8 * rank * (1 + flags) <= space.size, "a message that is cut off", space.at);
  std::uint64_t count = 1;
  for (std::uint64_t k = 0; k < rank; ++k) {
    const std::uint64_t extent = number(space.at + 8 + 8 * k, 8);
    require(flags == 0 || number(space.at + 8 + 8 * (rank + k), 8) == extent, "an extent that may grow",
            space.at);
    if (extent > most_values || count * extent > most_values)
      fail(path_,
           fmt::format("{} has an unusable number of values", object_.empty() ? "an attribute" : place()),
           std::to_string(extent), fmt::format("up to {}", most_values));
    count *= extent;
  }
  return count;
}

/// A group of the old kind (III.A.1, III.B to D).
void Walk::group(const SymbolTable& table, int depth)
{
  require(depth < most_depth, "too many groups within groups", table.tree);
  const Part names = heap(table.heap);
  const std::uint64_t level = number(table.tree + 5, 1);
  require(level <= most_levels, "an unusable tree", table.tree);
  tree(table.tree, level, names, depth);
}

/// A local heap (III.D): returns the segment that holds names.
Part Walk::heap(Address at)
{
  claim({at, 32});
  require(bytes(at, 4) == "HEAP" && number(at + 4, 4) == 0, "no heap", at);
  const Part data{number(at + 24, 8), number(at + 8, 8)};
  require(data.size > 0, "an empty heap", at);
  claim(data);
  // free blocks, each leading to one behind it or ending with 1
  std::uint64_t free = number(at + 16, 8);
  if (free == undefined) free = 1;
  for (std::uint64_t steps = 0; free != 1; ++steps) {
    require(free % 8 == 0 && free < data.size && data.size - free >= 16 && steps <= data.size / 16,
            "an unusable list of free blocks", at);
    const std::uint64_t size = number(data.at + free + 8, 8);
    require(size >= 16 && size <= data.size - free, "an unusable list of free blocks", at);
    free = number(data.at + free, 8);
  }
  return data;
}

std::string Walk::name(const Part& heap, std::uint64_t offset) const
{
  require(offset < heap.size, "a name outside its heap", heap.at);
  const Bytes text = bytes(heap.at + offset, heap.size - offset);
  const std::size_t end = text.find('\0');
  require(end != Bytes::npos, "a name without an end", heap.at + offset);
  require(end < 256, "a name that is too long", heap.at + offset);
  return std::string(text.substr(0, end));
}

/// A node of a group's B-tree (III.A.1) and all below it.
void Walk::tree(Address at, std::uint64_t level, const Part& names, int depth)
{
  constexpr std::uint64_t key = 8, child = 8, most = 2 * internal_k;
  claim({at, 24 + most * (key + child) + key});
  require(bytes(at, 4) == "TREE" && number(at + 4, 1) == 0 && number(at + 5, 1) == level,
          "no tree of a group", at);
  const std::uint64_t count = number(at + 6, 2);
  require(count <= most && (count > 0 || level == 0), "an unusable number of entries", at);
  for (std::uint64_t k = 0; k <= count; ++k) name(names, number(at + 24 + k * (key + child), 8));
  for (std::uint64_t k = 0; k < count; ++k) {
    const Address below = number(at + 24 + k * (key + child) + key, 8);
    if (level > 0)
      tree(below, level - 1, names, depth);
    else
      leaf(below, names, depth);
  }
}

/// A symbol table node (III.B).
void Walk::leaf(Address at, const Part& names, int depth)
{
  constexpr std::uint64_t entry_size = 40, most = 2 * leaf_k;
  claim({at, 8 + most * entry_size});
  require(bytes(at, 4) == "SNOD" && number(at + 4, 1) == 1, "no entries of a group", at);
  const std::uint64_t count = number(at + 6, 2);
  require(count > 0 && count <= most, "an unusable number of entries", at);
  for (std::uint64_t k = 0; k < count; ++k) entry(at + 8 + k * entry_size, names, depth);
}

/// A group's entry (III.C): a dataset, a group, or a soft link, which the reader refuses.
void Walk::entry(Address at, const Part& names, int depth)
{
  const std::string above = object_;
  object_ += '/' + name(names, number(at, 8));
  const std::uint64_t cached = number(at + 16, 4);
  require(cached <= 2, "an entry of unknown kind", at);
  if (cached == 2) {
    name(names, number(at + 24, 4));
  } else {
    const std::optional<SymbolTable> below = object(number(at + 8, 8));
    if (cached == 1)
      require(below && SymbolTable{number(at + 24, 8), number(at + 32, 8)} == *below,
              "a second account of a group", at);
    if (below) group(*below, depth + 1);
  }
  object_ = above;
}

}  // namespace

void check_structure(const std::string& path)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(file.tellg());
  if (!file || size < 0) fail(path, "cannot be read as a file");
  if (static_cast<std::uint64_t>(size) > most_bytes)
    fail(path, "is too large for a law file", fmt::format("{} bytes", size),
         fmt::format("up to {}", most_bytes));
  std::string content(static_cast<std::size_t>(size), '\0');
  if (!file.seekg(0).read(content.data(), size)) fail(path, "cannot be read as a file");
  Walk(path, content).file();
}

}  // namespace granulaw::h5
