#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Reads model files with errors that name the field, and writes them for people to read.
namespace raks::models {

/// A parsed document that remembers its first fault. Readers continue with default values after a
/// fault and ask for it once, at the end:
///
///     Expected<JsonDocument> document = JsonDocument::parse(text, "raks-hmm", 1);
///     model.name = document->root()["name"].text();
///     if (auto ok = document->finish(); !ok) { return fail(...); }   // "name is missing"
class JsonDocument {
 public:
    class Field;  ///< one value; below

    /// Errors: not JSON (with the line), nested deeper than 32, not an object with this "format", a
    /// version newer than `version` or not a positive whole number.
    [[nodiscard]] static Expected<JsonDocument> parse(std::string_view text,
                                                      std::string_view format,
                                                      int version);
    JsonDocument(JsonDocument&&) noexcept;             ///< fields stay valid
    JsonDocument& operator=(JsonDocument&&) noexcept;  ///< those of the source do
    ~JsonDocument();                                   ///< fields must be gone

    [[nodiscard]] Field root();  ///< the whole document
    /// Fails with the first fault, if there was one.
    [[nodiscard]] Expected<void> finish() const;

 private:
    JsonDocument();
    std::unique_ptr<nlohmann::json> json_;
    std::unique_ptr<std::optional<Error>> fault_;  // on the heap: fields point to it
};

/// One value in the document and the path to it. A missing or wrong value reads as 0, "" or empty
/// and is noted as a fault. Refers to the document, which must outlive it.
class JsonDocument::Field {
 public:
    [[nodiscard]] Field operator[](std::string_view key) const;  ///< of an object
    [[nodiscard]] Field operator[](std::size_t index) const;     ///< of an array
    [[nodiscard]] bool has(std::string_view key) const;          ///< an object with this key?
    /// Number of entries of an array.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] double number() const;  ///< finite
    /// A whole number in [lowest, highest].
    [[nodiscard]] int whole(int lowest, int highest) const;
    [[nodiscard]] std::string text() const;                                   ///< of a string
    [[nodiscard]] std::vector<double> numbers() const;                        ///< of an array
    [[nodiscard]] const std::string& path() const noexcept { return path_; }  ///< "genres[2].name"
    /// Notes a fault of this field, `PATH WHAT`; only the document's first fault is kept.
    void complain(const std::string& what) const;

 private:
    friend class JsonDocument;
    Field(const nlohmann::json* value, std::string path, std::optional<Error>* fault)
        : value_(value), path_(std::move(path)), fault_(fault) {}

    const nlohmann::json* value_;  // nullptr: missing
    std::string path_;
    std::optional<Error>* fault_;
};

/// A document as text that people can read and compare: one line for each field, lists of plain
/// values on one line; numbers in the shortest form that reads back to the same bits.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document);

}  // namespace raks::models
