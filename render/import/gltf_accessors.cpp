#include "render/import/gltf_accessors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostAccessors = 500'000;
constexpr std::int64_t kMostElements = 100'000'000;

struct ComponentInfo {
    std::int64_t code;
    std::size_t size;
    float largest;  ///< what a normalised one counts as 1
};
constexpr std::array<ComponentInfo, 6> kComponents = {{
    {5120, 1, 127.0F},
    {5121, 1, 255.0F},
    {5122, 2, 32767.0F},
    {5123, 2, 65535.0F},
    {5125, 4, 1.0F},
    {5126, 4, 1.0F},
}};

struct ElementInfo {
    std::string_view name;
    std::size_t columns;
    std::size_t rows;
};
constexpr std::array<ElementInfo, 7> kElements = {{
    {"SCALAR", 1, 1},
    {"VEC2", 1, 2},
    {"VEC3", 1, 3},
    {"VEC4", 1, 4},
    {"MAT2", 2, 2},
    {"MAT3", 3, 3},
    {"MAT4", 4, 4},
}};

const ComponentInfo& info(ComponentType type) {
    return kComponents[static_cast<std::size_t>(type)];
}

const ElementInfo& info(ElementType type) { return kElements[static_cast<std::size_t>(type)]; }

/// Bytes from column to column: those of matrices begin at multiples of 4.
std::size_t column_size(ElementType element, ComponentType component) {
    const std::size_t size = info(element).rows * info(component).size;
    return info(element).columns > 1 ? (size + 3) / 4 * 4 : size;
}

std::size_t element_size(ElementType element, ComponentType component) {
    return info(element).columns * column_size(element, component);
}

/// Bytes of an element without what may follow its last column.
std::size_t last_element_size(ElementType element, ComponentType component) {
    return element_size(element, component) - column_size(element, component) +
           info(element).rows * info(component).size;
}

ComponentType component_of(const JsonField& field) {
    const std::int64_t code = field.whole(0, std::numeric_limits<int>::max());
    for (std::size_t i = 0; i < kComponents.size(); ++i) {
        if (kComponents[i].code == code) {
            return static_cast<ComponentType>(i);
        }
    }
    field.complain(fmt::format("{} is not a value that glTF knows", code));
    return ComponentType::float32;
}

template <typename Stored, typename T>
T stored_at(const std::byte* place) {
    Stored value;
    std::memcpy(&value, place, sizeof(value));
    return static_cast<T>(value);
}

/// Reads one number after the other.
template <typename T>
T component_at(const std::byte* place, ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return stored_at<std::int8_t, T>(place);
        case ComponentType::uint8:
            return stored_at<std::uint8_t, T>(place);
        case ComponentType::int16:
            return stored_at<std::int16_t, T>(place);
        case ComponentType::uint16:
            return stored_at<std::uint16_t, T>(place);
        case ComponentType::uint32:
            return stored_at<std::uint32_t, T>(place);
        case ComponentType::float32:
            break;
    }
    return stored_at<float, T>(place);
}

/// Copies `count` elements that lie `stride` bytes apart.
template <typename T>
void unpack_elements(const std::byte* from,
                     std::size_t stride,
                     std::size_t count,
                     const GltfAccessor& accessor,
                     T* to) {
    const ElementInfo& element = info(accessor.element);
    const std::size_t size = info(accessor.component).size;
    const std::size_t column = column_size(accessor.element, accessor.component);
    if (std::is_same_v<T, float> && accessor.component == ComponentType::float32 &&
        stride == element_size(accessor.element, accessor.component)) {
        std::memcpy(to, from, count * stride);
        return;
    }
    for (std::size_t i = 0; i < count; ++i, from += stride) {
        for (std::size_t c = 0; c < element.columns; ++c) {
            for (std::size_t r = 0; r < element.rows; ++r) {
                *to++ = component_at<T>(from + c * column + r * size, accessor.component);
            }
        }
    }
}

}  // namespace

std::size_t GltfAccessors::width(ElementType element) noexcept {
    return info(element).columns * info(element).rows;
}

std::string_view GltfAccessors::name_of(ElementType element) noexcept { return info(element).name; }

GltfAccessors::GltfAccessors(const JsonField& root,
                             GltfBuffers& buffers,
                             ImportBudget& budget,
                             Model& model)
    : buffers_(buffers), budget_(budget), model_(model), uses_(buffers.view_count()) {
    const std::vector<JsonField> fields = root["accessors"].objects(kMostAccessors);
    accessors_.reserve(fields.size());
    for (const JsonField& field : fields) {
        accessors_.push_back(read(field));
    }
}

GltfAccessor GltfAccessors::read(const JsonField& field) {
    GltfAccessor accessor{.field = field};
    accessor.component = component_of(field["componentType"]);
    if (!field["type"].exists()) {
        field["type"].complain("is missing");
    }
    accessor.element = static_cast<ElementType>(
        field["type"].choice_or(0, {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}));
    accessor.count = static_cast<std::size_t>(field["count"].whole(1, kMostElements));
    accessor.view = field["bufferView"].index_or_none(buffers_.view_count());
    accessor.offset =
        static_cast<std::uint64_t>(field["byteOffset"].whole_or(0, 0, std::int64_t{1} << 30U));
    accessor.is_normalized = field["normalized"].truth_or(false);
    accessor.has_bounds = field["min"].exists() && field["max"].exists();
    if (accessor.is_normalized && info(accessor.component).largest == 1.0F) {
        warn(model_, field.line("is normalized, which only integers of 8 or 16 bits can be"));
    }
    if (accessor.view >= 0 && buffers_.view_count() > 0) {
        check_range(field,
                    accessor.view,
                    accessor.offset,
                    accessor.count,
                    accessor.element,
                    accessor.component);
    } else if (accessor.view < 0 && field["byteOffset"].exists()) {
        warn(model_, field.line("has a byteOffset, but no bufferView"));
    }
    if (const JsonField sparse = field["sparse"]; sparse.exists()) {
        read_sparse(accessor, sparse);
    }
    return accessor;
}

void GltfAccessors::read_sparse(GltfAccessor& accessor, const JsonField& field) {
    GltfAccessor::Sparse& sparse = accessor.sparse;
    accessor.is_sparse = true;
    sparse.count = static_cast<std::size_t>(
        field["count"].whole(1, static_cast<std::int64_t>(accessor.count)));
    const JsonField indices = field["indices"];
    sparse.index_component = component_of(indices["componentType"]);
    if (sparse.index_component != ComponentType::uint8 &&
        sparse.index_component != ComponentType::uint16 &&
        sparse.index_component != ComponentType::uint32) {
        indices["componentType"].complain("must be a type of unsigned integers");
    }
    const auto place = [&](const JsonField& part, int& view, std::uint64_t& offset) {
        view = part["bufferView"].index(buffers_.view_count());
        offset =
            static_cast<std::uint64_t>(part["byteOffset"].whole_or(0, 0, std::int64_t{1} << 30U));
    };
    place(indices, sparse.index_view, sparse.index_offset);
    place(field["values"], sparse.value_view, sparse.value_offset);
    if (buffers_.view_count() == 0) {
        return;  // noted
    }
    check_range(indices,
                sparse.index_view,
                sparse.index_offset,
                sparse.count,
                ElementType::scalar,
                sparse.index_component);
    check_range(field["values"],
                sparse.value_view,
                sparse.value_offset,
                sparse.count,
                accessor.element,
                accessor.component);
    for (const int view : {sparse.index_view, sparse.value_view}) {
        if (buffers_.stride(view) != 0) {
            warn(
                model_,
                field.line("its bufferView has a byteStride, which is allowed for vertices alone"));
        }
    }
}

void GltfAccessors::check_range(const JsonField& field,
                                int view,
                                std::uint64_t offset,
                                std::uint64_t count,
                                ElementType element,
                                ComponentType component) {
    const std::uint64_t length = buffers_.length(view);
    const std::size_t component_size = info(component).size;
    const std::size_t size = element_size(element, component);
    const std::size_t stride = buffers_.stride(view) != 0 ? buffers_.stride(view) : size;
    if (stride < size) {
        field.complain(fmt::format(
            "its elements of {} bytes lie {} bytes apart", size, buffers_.stride(view)));
        return;
    }
    // Both factors are below 2^30, so that nothing wraps.
    const std::uint64_t needed =
        count == 0 ? 0 : offset + stride * (count - 1) + last_element_size(element, component);
    if (needed > length) {
        field.complain(fmt::format(
            "{} elements need {} bytes; bufferViews[{}] has {}", count, needed, view, length));
    }
    if (offset % component_size != 0 || (buffers_.offset(view) + offset) % component_size != 0 ||
        stride % component_size != 0) {
        field.complain(fmt::format("byteOffset: not a multiple of {}", component_size));
    }
}

bool GltfAccessors::claim(const GltfAccessor& accessor, std::size_t size) {
    if (budget_.claim(accessor.count * width(accessor.element), size)) {
        return true;
    }
    accessor.field.complain("the model needs too much memory");
    return false;
}

template <typename T>
std::vector<T> GltfAccessors::raw(GltfAccessor& accessor) {
    accessor.is_read = true;
    if (!claim(accessor, sizeof(T))) {
        return {};
    }
    if (accessor.view < 0) {
        std::vector<T> numbers(accessor.count * width(accessor.element));
        if (accessor.is_sparse && !apply_sparse(accessor, numbers)) {
            return {};
        }
        return numbers;
    }
    const std::span<const std::byte> bytes = buffers_.bytes(accessor.view, accessor.field);
    const std::size_t size = element_size(accessor.element, accessor.component);
    const std::size_t stride =
        buffers_.stride(accessor.view) != 0 ? buffers_.stride(accessor.view) : size;
    if (accessor.count == 0 || accessor.offset + stride * (accessor.count - 1) +
                                       last_element_size(accessor.element, accessor.component) >
                                   bytes.size()) {
        return {};  // noted
    }
    std::vector<T> numbers(accessor.count * width(accessor.element));
    unpack_elements(
        bytes.data() + accessor.offset, stride, accessor.count, accessor, numbers.data());
    if (accessor.is_sparse && !apply_sparse(accessor, numbers)) {
        return {};
    }
    return numbers;
}

template <typename T>
bool GltfAccessors::apply_sparse(const GltfAccessor& accessor, std::vector<T>& numbers) {
    const GltfAccessor::Sparse& sparse = accessor.sparse;
    const std::size_t index_size = info(sparse.index_component).size;
    const std::size_t size = element_size(accessor.element, accessor.component);
    const auto indices = buffers_.bytes(sparse.index_view, accessor.field);
    const auto values = buffers_.bytes(sparse.value_view, accessor.field);
    if (sparse.index_offset + index_size * sparse.count > indices.size() ||
        sparse.value_offset + size * sparse.count > values.size()) {
        return false;  // noted
    }
    const std::size_t per_element = width(accessor.element);
    std::int64_t last = -1;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const auto index = component_at<std::uint32_t>(
            indices.data() + sparse.index_offset + i * index_size, sparse.index_component);
        if (index >= accessor.count || static_cast<std::int64_t>(index) <= last) {
            accessor.field["sparse"]["indices"].complain(fmt::format(
                "[{}] is {}, must be above {} and below {}", i, index, last, accessor.count));
            return false;
        }
        last = index;
        unpack_elements(values.data() + sparse.value_offset + i * size,
                        size,
                        1,
                        accessor,
                        numbers.data() + index * per_element);
    }
    return true;
}

bool GltfAccessors::are_finite(const GltfAccessor& accessor, const std::vector<float>& numbers) {
    // The sum is finite only if all are: one pass that the compiler makes wide.
    float sum = 0.0F;
    for (const float number : numbers) {
        sum += number * 0.0F;
    }
    if (sum == 0.0F) {
        return true;
    }
    const auto bad = std::find_if(
        numbers.begin(), numbers.end(), [](float number) { return !std::isfinite(number); });
    accessor.field.complain(
        fmt::format("element {} is not finite",
                    static_cast<std::size_t>(bad - numbers.begin()) / width(accessor.element)));
    return false;
}

void GltfAccessors::check_bounds(const GltfAccessor& accessor, const std::vector<float>& numbers) {
    const std::size_t per_element = width(accessor.element);
    const std::vector<float> least = accessor.field["min"].numbers(16);
    const std::vector<float> most = accessor.field["max"].numbers(16);
    if (least.size() != per_element || most.size() != per_element) {
        warn(model_, accessor.field.line("its min and max have too few or too many numbers"));
        return;
    }
    std::vector<float> low(numbers.begin(),
                           numbers.begin() + static_cast<std::ptrdiff_t>(per_element));
    std::vector<float> high = low;
    for (std::size_t i = per_element; i < numbers.size(); i += per_element) {
        for (std::size_t c = 0; c < per_element; ++c) {
            low[c] = std::min(low[c], numbers[i + c]);
            high[c] = std::max(high[c], numbers[i + c]);
        }
    }
    for (std::size_t c = 0; c < per_element; ++c) {
        // What rounding to a few decimals may do.
        const float slack =
            1e-3F * (high[c] - low[c]) + 1e-4F * std::max(std::abs(low[c]), std::abs(high[c]));
        if (std::abs(low[c] - least[c]) > slack + 1e-6F ||
            std::abs(high[c] - most[c]) > slack + 1e-6F) {
            warn(model_, accessor.field.line("its min and max differ from its numbers"));
            return;
        }
    }
}

std::vector<float> GltfAccessors::floats(int index) {
    GltfAccessor& accessor = accessors_[static_cast<std::size_t>(index)];
    const bool is_first_time = !accessor.is_read;
    std::vector<float> numbers = raw<float>(accessor);
    if (numbers.empty() || !are_finite(accessor, numbers)) {
        return {};
    }
    if (is_first_time && accessor.has_bounds) {
        check_bounds(accessor, numbers);
    }
    if (accessor.is_normalized) {
        const float scale = 1.0F / info(accessor.component).largest;
        for (float& number : numbers) {
            number = std::max(number * scale, -1.0F);
        }
    }
    return numbers;
}

std::vector<std::uint32_t> GltfAccessors::wholes(int index) {
    GltfAccessor& accessor = accessors_[static_cast<std::size_t>(index)];
    if (accessor.component != ComponentType::uint8 && accessor.component != ComponentType::uint16 &&
        accessor.component != ComponentType::uint32) {
        accessor.field["componentType"].complain("must be a type of unsigned integers");
        return {};
    }
    return raw<std::uint32_t>(accessor);
}

void GltfAccessors::use(int index, ViewUse use) {
    const GltfAccessor& accessor = accessors_[static_cast<std::size_t>(index)];
    if (accessor.view < 0) {
        return;
    }
    const std::size_t stride = buffers_.stride(accessor.view);
    const bool has_stride = stride != 0;
    const std::int64_t target = buffers_.target(accessor.view);
    if (target != 0 && target != (use == ViewUse::indices ? 34963 : 34962)) {
        warn(model_, accessor.field.line("its bufferView has the target of something else"));
    }
    if (use == ViewUse::vertices &&
        (accessor.offset % 4 != 0 ||
         (has_stride ? stride : element_size(accessor.element, accessor.component)) % 4 != 0)) {
        warn(model_, accessor.field.line("its vertices do not begin at multiples of 4 bytes"));
    }
    auto& first = uses_[static_cast<std::size_t>(accessor.view)];
    if (!first) {
        first = {use, index};
        if (has_stride && use != ViewUse::vertices) {
            warn(model_,
                 accessor.field.line(
                     "its bufferView has a byteStride, which is allowed for vertices alone"));
        }
    } else if (first->first != use) {
        warn(model_, accessor.field.line("its bufferView is used for something else, too"));
    } else if (first->second != index && use == ViewUse::vertices && !has_stride) {
        warn(model_, accessor.field.line("shares its bufferView, which has no byteStride"));
    }
}

void GltfAccessors::check_unread() {
    for (std::size_t i = 0; i < accessors_.size(); ++i) {
        if (accessors_[i].is_read) {
            continue;
        }
        JsonFaults faults;
        const JsonField whole = accessors_[i].field;
        accessors_[i].field =
            whole.noting_to(faults, fmt::format("accessors[{}], which nothing uses", i));
        (void)floats(static_cast<int>(i));
        accessors_[i].field = whole;
        if (faults.any()) {
            warn(model_, faults.finish().error().message);
        }
    }
}

}  // namespace raks::render
