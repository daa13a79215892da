#include "hdf5.hpp"

#include "description.hpp"

#include <algorithm>
#include <cstring>
#include <exception>

namespace elvis::native::h5 {

namespace {

/** Bytes of a chunk: large enough to compress well, small enough to be read for the sake of a few elements. */
constexpr std::size_t chunk_bytes = 128 * 1024;
/** Fast, and on shuffled coefficients within a few percent of the best. */
constexpr unsigned compression_level = 1;

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
    auto& message = *static_cast<std::string*>(text);
    if (message.empty() && error->desc) {
        message = error->desc;
    }
    return 0;
}

/** Element type of fixed-length text, padded with NUL. */
Handle text_type(std::size_t length, const Place& place) {
    Handle type(check(H5Tcopy(H5T_C_S1), place, "no memory for a type"), H5Tclose);
    check(H5Tset_size(type.id(), std::max<std::size_t>(1, length)), place, "a text has an impossible length");
    H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
    H5Tset_cset(type.id(), H5T_CSET_UTF8);
    return type;
}

std::string trimmed(const char* text, std::size_t length) { return {text, strnlen(text, length)}; }

std::size_t checked_text_length(hid_t type, const Place& place) {
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) {
        place.fail("is not text of fixed length");
    }
    const std::size_t length = H5Tget_size(type);
    if (length == 0 || length > longest_text) {
        place.fail("has texts of " + std::to_string(length) + " bytes");
    }
    return length;
}

std::string type_name(hid_t type) {
    const char* kind = H5Tget_class(type) == H5T_FLOAT ? "float" : H5Tget_sign(type) == H5T_SGN_NONE ? "unsigned int" : "int";
    return "little-endian " + std::string(kind) + std::to_string(8 * H5Tget_size(type));
}

std::string shape_text(const std::vector<hsize_t>& shape) {
    std::string text;
    for (const hsize_t extent : shape) {
        text += (text.empty() ? "" : ", ") + std::to_string(extent);
    }
    return "(" + text + ")";
}

void transfer(const Handle& dataset, hid_t type, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count,
              void* target, const void* origin, const Place& place) {
    if (std::find(count.begin(), count.end(), 0u) != count.end()) {
        return;
    }
    const Handle in_file(check(H5Dget_space(dataset.id()), place, "has no shape"), H5Sclose);
    check(H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), place,
          "does not reach so far");
    const Handle in_memory(check(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), place, "no memory"),
                           H5Sclose);
    if (target) {
        check(H5Dread(dataset.id(), type, in_memory.id(), in_file.id(), H5P_DEFAULT, target), place, "cannot be read");
    } else {
        check(H5Dwrite(dataset.id(), type, in_memory.id(), in_file.id(), H5P_DEFAULT, origin), place, "cannot be written");
    }
}

} // namespace

namespace {

std::mutex& process_mutex() {
    static std::mutex mutex;
    return mutex;
}

} // namespace

Lock::Lock() : m_guard(process_mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &m_printer, &m_printer_data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Lock::~Lock() {
    if (std::uncaught_exceptions() == 0) {
        H5Eset_auto2(H5E_DEFAULT, m_printer, m_printer_data);
    }
}

void Place::fail(const std::string& what) const { throw FileError(file, (object.empty() ? "/" : object) + " " + what); }

void Place::fail_with_stack(const std::string& what) const {
    std::string innermost;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &innermost);
    H5Eclear2(H5E_DEFAULT);
    fail(what + (innermost.empty() ? "" : " (" + innermost + ")"));
}

Handle open_group(const Handle& parent, const std::string& name, const Place& place) {
    return {check(H5Gopen2(parent.id(), name.c_str(), H5P_DEFAULT), place, "is missing or damaged"), H5Gclose};
}

Handle create_group(const Handle& parent, const std::string& name, const Place& place) {
    return {check(H5Gcreate2(parent.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), place, "cannot be created"),
            H5Gclose};
}

void write_attribute_raw(const Handle& object, const char* name, hid_t in_file, hid_t in_memory, const void* data,
                         hsize_t count, const Place& place) {
    const Place here = place.child(name);
    const Handle space(check(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), here, "no memory"),
                       H5Sclose);
    const Handle attribute(
        check(H5Acreate2(object.id(), name, in_file, space.id(), H5P_DEFAULT, H5P_DEFAULT), here, "cannot be created"),
        H5Aclose);
    check(H5Awrite(attribute.id(), in_memory, data), here, "cannot be written");
}

void read_attribute_raw(const Handle& object, const char* name, hid_t in_file, hid_t in_memory, void* data, hsize_t count,
                        const Place& place) {
    const Place here = place.child(name);
    const Handle attribute(check(H5Aopen(object.id(), name, H5P_DEFAULT), here, "is missing or damaged"), H5Aclose);
    const Handle type(check(H5Aget_type(attribute.id()), here, "has no type"), H5Tclose);
    const Handle space(check(H5Aget_space(attribute.id()), here, "has no shape"), H5Sclose);
    if (H5Tequal(type.id(), in_file) <= 0) {
        here.fail("has another type than " + type_name(in_file));
    }
    const hssize_t found = H5Sget_simple_extent_npoints(space.id());
    if (found != static_cast<hssize_t>(count)) {
        here.fail("has " + std::to_string(found) + " values where " + std::to_string(count) + " belong");
    }
    check(H5Aread(attribute.id(), in_memory, data), here, "cannot be read");
}

void write_text(const Handle& object, const char* name, const std::string& text, const Place& place) {
    const Place here = place.child(name);
    const Handle type = text_type(text.size(), here);
    std::string padded = text;
    padded.resize(std::max<std::size_t>(1, text.size()), '\0');
    write_attribute_raw(object, name, type.id(), type.id(), padded.data(), 1, place);
}

std::string read_text(const Handle& object, const char* name, const Place& place) {
    const Place here = place.child(name);
    const Handle attribute(check(H5Aopen(object.id(), name, H5P_DEFAULT), here, "is missing or damaged"), H5Aclose);
    const Handle type(check(H5Aget_type(attribute.id()), here, "has no type"), H5Tclose);
    const Handle space(check(H5Aget_space(attribute.id()), here, "has no shape"), H5Sclose);
    const std::size_t length = checked_text_length(type.id(), here);
    if (H5Sget_simple_extent_npoints(space.id()) != 1) {
        here.fail("is not one text");
    }
    std::string text(length, '\0');
    check(H5Aread(attribute.id(), type.id(), text.data()), here, "cannot be read");
    return trimmed(text.data(), length);
}

Handle create_dataset(const Handle& parent, const std::string& name, hid_t type, const std::vector<hsize_t>& shape,
                      std::size_t row_dimension, std::size_t bytes_a_row, const Place& place) {
    const Place here = place.child(name);
    const int rank = static_cast<int>(shape.size());
    const Handle space(check(H5Screate_simple(rank, shape.data(), nullptr), here, "has an impossible shape"), H5Sclose);
    std::vector<hsize_t> chunk = shape;
    std::fill_n(chunk.begin(), row_dimension, hsize_t{1});
    const hsize_t rows = std::max<hsize_t>(1, chunk_bytes / std::max<std::size_t>(1, bytes_a_row));
    chunk[row_dimension] = std::min(rows, shape[row_dimension]);
    const Handle list(check(H5Pcreate(H5P_DATASET_CREATE), here, "no memory"), H5Pclose);
    check(H5Pset_chunk(list.id(), rank, chunk.data()), here, "cannot be cut into chunks");
    check(H5Pset_shuffle(list.id()), here, "cannot be shuffled");
    check(H5Pset_deflate(list.id(), compression_level), here, "cannot be compressed");
    check(H5Pset_fletcher32(list.id()), here, "cannot be checksummed");
    return {check(H5Dcreate2(parent.id(), name.c_str(), type, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT), here,
                  "cannot be created"),
            H5Dclose};
}

bool has_object(const Handle& group, const std::string& name, const Place& place) {
    return check(H5Lexists(group.id(), name.c_str(), H5P_DEFAULT), place, "is damaged") > 0;
}

Handle open_dataset(const Handle& parent, const std::string& name, hid_t type, const std::vector<hsize_t>& shape,
                    const Place& place) {
    const Place here = place.child(name);
    Handle dataset(check(H5Dopen2(parent.id(), name.c_str(), H5P_DEFAULT), here, "is missing or damaged"), H5Dclose);
    const Handle found_type(check(H5Dget_type(dataset.id()), here, "has no type"), H5Tclose);
    if (H5Tget_class(type) == H5T_STRING) {
        checked_text_length(found_type.id(), here);
    } else if (H5Tequal(found_type.id(), type) <= 0) {
        here.fail("has another type than " + type_name(type));
    }
    const Handle space(check(H5Dget_space(dataset.id()), here, "has no shape"), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    std::vector<hsize_t> found(rank > 0 ? static_cast<std::size_t>(rank) : 0);
    if (rank > 0) {
        H5Sget_simple_extent_dims(space.id(), found.data(), nullptr);
    }
    if (found != shape) {
        here.fail("has the shape " + shape_text(found) + " where the rest of the file asks for " + shape_text(shape));
    }
    const Handle list(check(H5Dget_create_plist(dataset.id()), here, "is damaged"), H5Pclose);
    std::vector<hsize_t> chunk(shape.size());
    if (H5Pget_layout(list.id()) != H5D_CHUNKED || H5Pget_chunk(list.id(), rank, chunk.data()) != rank) {
        here.fail("is not stored in chunks");
    }
    // A chunk without checksum, or one that was never written and would read as zeros, must not pass for data.
    unsigned flags = 0;
    std::size_t n_values = 0;
    if (H5Pget_filter_by_id2(list.id(), H5Z_FILTER_FLETCHER32, &flags, &n_values, nullptr, 0, nullptr, nullptr) < 0) {
        H5Eclear2(H5E_DEFAULT);
        here.fail("has no checksums");
    }
    hsize_t expected = 1;
    for (std::size_t dimension = 0; dimension < shape.size(); ++dimension) {
        expected *= shape[dimension] == 0 ? 0 : (shape[dimension] - 1) / chunk[dimension] + 1;
    }
    hsize_t present = 0;
    if (expected > 0) {
        check(H5Dget_num_chunks(dataset.id(), space.id(), &present), here, "is damaged");
    }
    if (present != expected) {
        here.fail("is incomplete: " + std::to_string(present) + " of " + std::to_string(expected) + " chunks are there");
    }
    return dataset;
}

void read_box(const Handle& dataset, hid_t type, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count,
              void* data, const Place& place) {
    transfer(dataset, type, start, count, data, nullptr, place);
}

void write_box(const Handle& dataset, hid_t type, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count,
               const void* data, const Place& place) {
    transfer(dataset, type, start, count, nullptr, data, place);
}

void write_texts(const Handle& parent, const std::string& name, const std::vector<std::string>& texts,
                 const std::vector<hsize_t>& shape, const Place& place) {
    std::size_t length = 1;
    for (const std::string& text : texts) {
        length = std::max(length, text.size());
    }
    std::string padded(length * texts.size(), '\0');
    for (std::size_t index = 0; index < texts.size(); ++index) {
        texts[index].copy(padded.data() + index * length, length);
    }
    const Place here = place.child(name);
    const Handle type = text_type(length, here);
    const Handle dataset = create_dataset(parent, name, type.id(), shape, 0, length * texts.size() / shape[0], place);
    write_box(dataset, type.id(), std::vector<hsize_t>(shape.size(), 0), shape, padded.data(), here);
}

std::vector<std::string> read_texts(const Handle& parent, const std::string& name, const std::vector<hsize_t>& shape,
                                    const Place& place) {
    const Place here = place.child(name);
    const Handle dataset = open_dataset(parent, name, H5T_C_S1, shape, place);
    const Handle type(check(H5Dget_type(dataset.id()), here, "has no type"), H5Tclose);
    const std::size_t length = checked_text_length(type.id(), here);
    std::size_t count = 1;
    for (const hsize_t extent : shape) {
        count *= extent;
    }
    if (count > (std::size_t{1} << 30) / length) {
        here.fail("has more text than a volume can have");
    }
    std::string padded(length * count, '\0');
    read_box(dataset, type.id(), std::vector<hsize_t>(shape.size(), 0), shape, padded.data(), here);
    std::vector<std::string> texts;
    for (std::size_t index = 0; index < count; ++index) {
        texts.push_back(trimmed(padded.data() + index * length, length));
    }
    return texts;
}

} // namespace elvis::native::h5
