#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"

/// Reads JSON of unknown origin, with errors that name the place. The parser (simdjson) stays
/// behind this header.
///
///     JsonFaults faults;
///     const JsonField node = document.root(faults)["nodes"].items()[3];
///     const int mesh = node["mesh"].index_or_none(meshes);  // -1: there is none
///     if (auto ok = faults.finish(); !ok) { ... }           // "nodes[3].mesh: 9 is not one of 5"
namespace raks::render {

/// The first fault of what is read, and the paths of the fields that were asked for. Reading goes
/// on with default values after a fault; it is asked for once, at the end.
class JsonFaults {
 public:
    [[nodiscard]] bool any() const noexcept { return first_.has_value(); }
    /// Fails with the first fault, if there was one.
    [[nodiscard]] Expected<void> finish() const;
    /// Keeps a fault, if it is the first.
    void add(const std::string& line);

 private:
    friend class JsonField;
    /// One key or index on the way to a field.
    struct Step {
        std::uint32_t parent = 0;  ///< in steps_; 0: the root
        std::uint32_t index = 0;   ///< of an array
        std::string_view key;      ///< of an object; no data: an index
    };
    std::uint32_t step(const Step& step);
    [[nodiscard]] std::string path(std::uint32_t step) const;

    std::optional<Error> first_;
    std::vector<Step> steps_{1};
    std::list<std::string> prefixes_;  // steps look into them
};

/// One value of a document and the path to it, or none: a field that is not there. What asks for a
/// value that is missing or of another kind notes a fault and reads as 0, "" or empty; what takes a
/// default notes a fault only where the value is of another kind or out of range. Refers to the
/// document and the faults, which must outlive it.
class JsonField {
 public:
    /// A member of an object; also of a field that is not there. Where there is none, `key` must
    /// live as long as the field that is returned: a literal does.
    [[nodiscard]] JsonField operator[](std::string_view key) const;
    /// The same field, whose faults (and its parts') go to others: a part of the file that may be
    /// bad without the file being bad. `prefix`: path of this field in those faults.
    [[nodiscard]] JsonField noting_to(JsonFaults& faults, std::string_view prefix = {}) const;

    [[nodiscard]] bool exists() const noexcept { return document_ != nullptr; }
    [[nodiscard]] bool is_object() const;
    [[nodiscard]] bool is_array() const;
    [[nodiscard]] bool is_text() const;
    [[nodiscard]] bool is_number() const;

    /// All of an array; empty where there is none. Faults: not an array, more than `most`.
    [[nodiscard]] std::vector<JsonField> items(std::size_t most = 1'000'000) const;
    /// The same of objects. Faults: an entry that is none.
    [[nodiscard]] std::vector<JsonField> objects(std::size_t most = 1'000'000) const;
    /// All of an object, with their keys; empty where there is none. Faults: not an object.
    [[nodiscard]] std::vector<std::pair<std::string_view, JsonField>> entries() const;
    /// Entries of an array or object; 0 of all else.
    [[nodiscard]] std::size_t size() const;

    /// UTF-8, checked; may hold control characters.
    [[nodiscard]] std::string_view text() const;
    [[nodiscard]] std::string_view text_or(std::string_view otherwise) const;
    [[nodiscard]] bool truth_or(bool otherwise) const;
    /// A finite number in [lowest, highest].
    [[nodiscard]] float number(float lowest, float highest) const;
    [[nodiscard]] float number_or(float otherwise, float lowest, float highest) const;
    /// A whole number in [lowest, highest]; 4.0 is one.
    [[nodiscard]] std::int64_t whole(std::int64_t lowest, std::int64_t highest) const;
    [[nodiscard]] std::int64_t whole_or(std::int64_t otherwise,
                                        std::int64_t lowest,
                                        std::int64_t highest) const;
    /// An index in an array of `count`; 0 after a fault.
    [[nodiscard]] int index(std::size_t count) const;
    /// The same, or -1 where there is none.
    [[nodiscard]] int index_or_none(std::size_t count) const;
    /// An array of finite numbers. Faults: more than `most`, one that is none.
    [[nodiscard]] std::vector<float> numbers(std::size_t most) const;
    /// Exactly N finite numbers.
    template <std::size_t N>
    [[nodiscard]] std::array<float, N> numbers_or(std::array<float, N> otherwise) const {
        if (exists()) {
            read_exactly(otherwise.data(), N);
        }
        return otherwise;
    }
    /// Place of the text in `words`; 0 after a fault. Missing: `otherwise`.
    [[nodiscard]] std::size_t choice_or(std::size_t otherwise,
                                        std::initializer_list<std::string_view> words) const;

    /// "nodes[3].mesh"
    [[nodiscard]] std::string path() const;
    /// Notes a fault of this field: "PATH: WHAT".
    void complain(const std::string& what) const;
    /// The same as a line, for a warning.
    [[nodiscard]] std::string line(std::string_view what) const;

 private:
    friend class JsonDocument;
    JsonField(const void* document, std::size_t place, JsonFaults& faults, std::uint32_t step)
        : document_(document), place_(place), faults_(&faults), step_(step) {}
    /// Writes `count` numbers to `out`, or nothing and notes a fault.
    void read_exactly(float* out, std::size_t count) const;
    /// Notes that the value is missing, or not `wanted`.
    void complain_of_kind(std::string_view wanted) const;

    const void* document_;  // simdjson's; nullptr: there is no value
    std::size_t place_;     // on simdjson's tape
    JsonFaults* faults_;
    std::uint32_t step_;
};

/// A parsed document.
class JsonDocument {
 public:
    /// Errors: no JSON (UTF-8 alone), nested deeper than 64, the top no object, a key that stands
    /// twice in one object (which of them counts is anybody's guess).
    [[nodiscard]] static Expected<JsonDocument> parse(std::string_view text);
    JsonDocument(JsonDocument&&) noexcept;  ///< fields stay valid
    JsonDocument& operator=(JsonDocument&&) noexcept;
    ~JsonDocument();

    /// The whole document; faults of its fields go to `faults`.
    [[nodiscard]] JsonField root(JsonFaults& faults) const;

 private:
    struct Parsed;
    explicit JsonDocument(std::unique_ptr<Parsed> parsed);
    std::unique_ptr<Parsed> parsed_;
};

}  // namespace raks::render
