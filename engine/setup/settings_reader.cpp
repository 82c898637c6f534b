#include "engine/setup/settings_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// A value that is one text, or several.
using Texts = std::vector<std::string>;

// "FILE: line N": how errors name a place.
std::string where(const std::string& name, const toml::source_region& source) {
    return fmt::format("{}: line {}", name, source.begin.line);
}

// A text, or a list of texts that is not empty; none: it is something else.
std::optional<Texts> texts_of(const toml::node& node) {
    if (const auto* const text = node.as_string()) {
        return Texts{text->get()};
    }
    const toml::array* const list = node.as_array();
    if (list == nullptr || list->empty()) {
        return std::nullopt;
    }
    Texts texts;
    for (const toml::node& element : *list) {
        const auto* const text = element.as_string();
        if (text == nullptr) {
            return std::nullopt;
        }
        texts.push_back(text->get());
    }
    return texts;
}

// Puts one value of the file into its field; returns the error's message, or nothing.
std::string assign(const SettingRow& row, const toml::node& node, Settings& settings) {
    return std::visit(
        [&](auto field) -> std::string {
            using T = std::remove_reference_t<decltype(settings.*field)>;
            if constexpr (std::is_same_v<T, Texts>) {
                auto texts = texts_of(node);
                if (!texts) {
                    return full_name(row) + " must be a text, or a list of texts";
                }
                settings.*field = std::move(*texts);
                return {};
            } else {
                // node.value() converts between whole numbers, decimals and truth values; a file
                // must not mean one by another. A whole number for a decimal is fine.
                const std::optional<T> value =
                    std::is_same_v<T, double> ? node.value<T>() : node.value_exact<T>();
                if (!value) {
                    constexpr std::string_view kind = std::is_same_v<T, std::string> ? "a text"
                                                      : std::is_same_v<T, bool> ? "true or false"
                                                                                : "a number";
                    return fmt::format("{} must be {}", full_name(row), kind);
                }
                settings.*field = *value;
                return {};
            }
        },
        row.field);
}

// The keys of a file that are unknown: a newer version may have written it, and what it says of
// others holds.
class UnknownKeys {
 public:
    explicit UnknownKeys(std::string file) : file_(std::move(file)) {}

    // The nearest is looked for among `known`.
    void add(const toml::node& node,
             const std::string& key,
             std::span<const std::string_view> known) {
        constexpr std::size_t kMostLines = 5;
        if (++count_ <= kMostLines) {
            const std::string name = printable(key, 60);
            lines_.push_back(fmt::format("{}: key \"{}\" is unknown and ignored{}",
                                         where(file_, node.source()),
                                         name,
                                         suggestion(name, known)));
        }
    }
    [[nodiscard]] SettingsNotes lines() && {
        if (count_ > lines_.size()) {
            lines_.push_back(
                fmt::format("{}: {} more keys are unknown", file_, count_ - lines_.size()));
        }
        return std::move(lines_);
    }

 private:
    std::string file_;
    SettingsNotes lines_;
    std::size_t count_ = 0;
};

bool holds(const SettingsForm& form, const SettingRow& row) {
    return form.fields.empty() ||
           std::find(form.fields.begin(), form.fields.end(), row.field) != form.fields.end();
}

// Reads one document of a form over settings.
class TableReader {
 public:
    TableReader(const std::string& name, const SettingsForm& form, Settings& settings)
        : name_(name), form_(form), settings_(settings), unknown_(name) {
        for (const SettingRow& row : setting_rows()) {
            if (holds(form, row)) {
                know(row.section, row.name);
            }
        }
        for (const OwnKey& key : form.own_keys) {
            know(key.section, key.name);
        }
    }

    Expected<SettingsNotes> read(const toml::table& table) && {
        if (auto checked = check_head(table); !checked) {
            return fail(std::move(checked.error()));
        }
        for (const auto& entry : table) {
            const std::string_view key = entry.first.str();
            if (key == "format" || key == "version") {
                continue;
            }
            if (auto read = read_entry(key, entry.second); !read) {
                return fail(std::move(read.error()));
            }
        }
        return std::move(unknown_).lines();
    }

 private:
    void know(std::string_view section, std::string_view key) {
        if (std::find(sections_.begin(), sections_.end(), section) == sections_.end()) {
            sections_.push_back(section);
        }
        keys_.push_back(fmt::format("{}.{}", section, key));
    }

    // Both are optional: a file written by hand may consist of keys alone. They are checked before
    // the keys, so that a newer file is told from one with a mistake.
    [[nodiscard]] Expected<void> check_head(const toml::table& table) const {
        if (table["format"].value_or(std::string(form_.format)) != form_.format) {
            return fail(fmt::format(
                "{}: format is not \"{}\"; this is another kind of file", name_, form_.format));
        }
        const auto version = table["version"].value_exact<std::int64_t>();
        if (table.contains("version") && version != kSettingsVersion) {
            return fail(
                fmt::format("{}: version {} is not known to this Raks (it reads version {})",
                            name_,
                            version ? std::to_string(*version) : "of another kind",
                            kSettingsVersion));
        }
        return {};
    }

    [[nodiscard]] Expected<void> read_entry(std::string_view key, const toml::node& node) {
        if (std::find(sections_.begin(), sections_.end(), key) == sections_.end()) {
            std::vector<std::string_view> known = sections_;
            known.insert(known.end(), {"format", "version"});
            unknown_.add(node, std::string(key), known);
            return {};
        }
        return node.is_table() ? read_section(key, *node.as_table())
                               : fail(fmt::format(
                                     "{}: {} must be a section", where(name_, node.source()), key));
    }

    // Reads one section, such as [audio].
    [[nodiscard]] Expected<void> read_section(std::string_view section, const toml::table& table) {
        for (const auto& entry : table) {
            const toml::node& node = entry.second;
            const std::string key = fmt::format("{}.{}", section, entry.first.str());
            // The suggestion is looked for among the names of all sections: a key may stand in a
            // wrong one.
            if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) {
                const std::vector<std::string_view> known(keys_.begin(), keys_.end());
                unknown_.add(node, key, known);
                continue;
            }
            const auto rows = setting_rows();
            const auto row = std::find_if(
                rows.begin(), rows.end(), [&](const auto& each) { return full_name(each) == key; });
            if (row == rows.end()) {
                continue;  // the caller's own
            }
            if (const std::string fault = assign(*row, node, settings_); !fault.empty()) {
                return fail(where(name_, node.source()) + ": " + fault);
            }
            settings_.origins.set(key, {form_.rank, name_, node.source().begin.line});
        }
        return {};
    }

    const std::string& name_;
    const SettingsForm& form_;
    Settings& settings_;
    UnknownKeys unknown_;
    std::vector<std::string_view> sections_;  // of the form
    std::vector<std::string> keys_;           // "picture.theme"
};

}  // namespace

Expected<SettingsNotes> read_settings_table(const toml::table& table,
                                            const std::string& name,
                                            const SettingsForm& form,
                                            Settings& settings) {
    return TableReader(name, form, settings).read(table);
}

std::string toml_texts(const Texts& texts) {
    return texts.size() == 1 ? toml_quoted(texts.front()) : toml_list(texts);
}

std::string toml_list(const Texts& texts) {
    std::string list;
    for (const std::string& text : texts) {
        list += (list.empty() ? "" : ", ") + toml_quoted(text);
    }
    return "[" + list + "]";
}

std::string toml_value(const SettingRow& row, const Settings& settings) {
    return std::visit(
        [&](auto field) -> std::string {
            using T = std::decay_t<decltype(settings.*field)>;
            if constexpr (std::is_same_v<T, std::string>) {
                return toml_quoted(settings.*field);
            } else if constexpr (std::is_same_v<T, Texts>) {
                return toml_texts(settings.*field);
            } else if constexpr (std::is_same_v<T, double>) {
                const std::string number = fmt::format("{}", settings.*field);
                // A decimal point, so that TOML reads the number back as a decimal.
                return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
            } else {
                return fmt::format("{}", settings.*field);
            }
        },
        row.field);
}

void TomlSections::add(std::string_view section, std::string_view name, const std::string& value) {
    auto found = std::find_if(sections_.begin(), sections_.end(), [&](const auto& each) {
        return each.first == section;
    });
    if (found == sections_.end()) {
        found = sections_.insert(found, {std::string(section), {}});
    }
    found->second += fmt::format("{} = {}\n", name, value);
}

std::string TomlSections::text() const {
    std::string text;
    for (const auto& [name, lines] : sections_) {
        text += fmt::format("\n[{}]\n{}", name, lines);
    }
    return text;
}

}  // namespace raks::engine
