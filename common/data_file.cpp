#include "common/data_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <utility>

#include "common/errors.hpp"

namespace common {

namespace fs = std::filesystem;

namespace {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    bool is_valid() const { return id_ >= 0; }
    operator hid_t() const { return id_; }

 private:
    hid_t id_;
    Close close_;
};

void silence_library_messages() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
hid_t memory_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
hid_t memory_type<std::uint64_t>() {
    return H5T_NATIVE_UINT64;
}

template <class T>
hid_t stored_type();
template <>
hid_t stored_type<double>() {
    return H5T_IEEE_F64LE;
}
template <>
hid_t stored_type<float>() {
    return H5T_IEEE_F32LE;
}
template <>
hid_t stored_type<std::int32_t>() {
    return H5T_STD_I32LE;
}
template <>
hid_t stored_type<std::uint64_t>() {
    return H5T_STD_U64LE;
}

// ---------------------------------------------------------------- writing

void require_built(bool succeeded, const fs::path& path, const std::string& what) {
    if (!succeeded) throw RunError(fmt::format("{}: cannot build {} (out of memory?)", path.string(), what));
}

void write_attribute(hid_t object, const std::string& name, const Attribute& value, const fs::path& path) {
    Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const auto write = [&](hid_t stored, hid_t memory, const void* data) {
        Handle attribute(H5Acreate2(object, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        require_built(attribute.is_valid() && H5Awrite(attribute, memory, data) >= 0, path,
                      "attribute " + name);
    };
    if (const auto* text = std::get_if<std::string>(&value)) {
        Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        H5Tset_size(type, text->empty() ? 1 : text->size());
        H5Tset_cset(type, H5T_CSET_UTF8);
        write(type, type, text->empty() ? "" : text->data());
    } else if (const auto* number = std::get_if<double>(&value)) {
        write(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, number);
    } else {
        write(H5T_STD_I64LE, H5T_NATIVE_INT64, &std::get<std::int64_t>(value));
    }
}

/// Creates the groups on the way to `dataset` that are not there. HDF5 would do so by itself, but with the
/// time of day in their headers: same content must give the same bytes.
void create_groups(hid_t file, const std::string& dataset, const fs::path& path) {
    for (auto slash = dataset.find('/', 1); slash != std::string::npos;
         slash = dataset.find('/', slash + 1)) {
        const std::string group = dataset.substr(0, slash);
        if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
        Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
        H5Pset_obj_track_times(creation, 0);
        Handle created(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
        require_built(created.is_valid(), path, "group " + group);
    }
}

void write_dataset(hid_t file, const std::string& name, const Dataset& dataset, const fs::path& path) {
    const std::size_t expected =
        std::accumulate(dataset.shape.begin(), dataset.shape.end(), std::size_t{1}, std::multiplies<>());
    if (expected != dataset.size())
        throw RunError(fmt::format("{}: dataset {} has {} values for shape {}", path.string(), name,
                                   dataset.size(), fmt::join(dataset.shape, " x ")));
    const std::vector<hsize_t> extent(dataset.shape.begin(), dataset.shape.end());
    Handle space(extent.empty() ? H5Screate(H5S_SCALAR)
                                : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                 H5Sclose);
    create_groups(file, name, path);
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, 0);  // same content, same bytes
    if (!extent.empty() && expected > 0) {
        // Contiguous data would be read silently wrong when a bit flips; one chunk with a checksum is not.
        H5Pset_chunk(creation, static_cast<int>(extent.size()), extent.data());
        H5Pset_fletcher32(creation);
    }
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
            Handle set(
                H5Dcreate2(file, name.c_str(), stored_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                H5Dclose);
            require_built(set.is_valid(), path, "dataset " + name);
            if (!values.empty())
                require_built(
                    H5Dwrite(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, path,
                    "dataset " + name);
            write_attribute(set, "units", dataset.unit, path);
        },
        dataset.values);
}

/// Keeps the memory of an in-memory HDF5 file after it was closed. (H5Fget_file_image would give the bytes of
/// the open file, whose superblock is marked as being written.)
class MemoryImage {
 public:
    explicit MemoryImage(hid_t access) {
        constexpr std::size_t increment = 1 << 20;
        H5Pset_fapl_core(access, increment, false);
        H5FD_file_image_callbacks_t callbacks{};
        callbacks.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void*) {
            return std::malloc(size);
        };
        callbacks.image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t,
                                    void*) { return std::memcpy(to, from, size); };
        callbacks.image_realloc = [](void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
            return std::realloc(memory, size);
        };
        callbacks.image_free = [](void* memory, H5FD_file_image_op_t operation, void* self) -> herr_t {
            void*& kept = static_cast<MemoryImage*>(self)->memory_;
            std::free(operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE ? std::exchange(kept, memory) : memory);
            return 0;
        };
        callbacks.udata_copy = [](void* self) { return self; };
        callbacks.udata_free = [](void*) -> herr_t { return 0; };
        callbacks.udata = this;
        H5Pset_file_image_callbacks(access, &callbacks);
    }
    MemoryImage(const MemoryImage&) = delete;
    MemoryImage& operator=(const MemoryImage&) = delete;
    ~MemoryImage() { std::free(memory_); }

    /// The bytes, once the file is closed; empty when it could not be closed well.
    std::string_view bytes() const {
        // Superblock versions 2 and 3: end of file in the eight bytes from 28 on. The memory may reach
        // farther.
        constexpr std::size_t version_at = 8, end_at = 28;
        const char* image = static_cast<const char*>(memory_);
        if (image == nullptr || image[version_at] < 2) return {};
        std::uint64_t end = 0;
        std::memcpy(&end, image + end_at, sizeof end);
        return {image, end};
    }

 private:
    void* memory_ = nullptr;
};

/// A temporary file beside `path` that is removed unless it was renamed into place.
class TemporaryFile {
 public:
    explicit TemporaryFile(const fs::path& path)
        : target_(path),
          name_(path.parent_path() / fmt::format(".{}.{}.tmp", path.filename().string(), ::getpid())) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!published_) ::unlink(name_.c_str());
    }
    const fs::path& name() const { return name_; }

    /// Renames the file into place; `durable`: fsync the file before and the folder after.
    void publish(bool durable) {
        if (durable) sync(name_, O_RDWR);
        if (::rename(name_.c_str(), target_.c_str()) != 0)
            throw RunError(target_.string() + ": cannot rename into place: " + std::strerror(errno));
        published_ = true;
        if (durable)
            sync(target_.parent_path().empty() ? fs::path(".") : target_.parent_path(),
                 O_RDONLY | O_DIRECTORY);
    }

 private:
    static void sync(const fs::path& path, int flags) {
        const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
        const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
        const int reason = errno;
        if (descriptor >= 0) ::close(descriptor);
        if (!synced) throw RunError(fmt::format("{}: cannot sync: {}", path.string(), std::strerror(reason)));
    }
    fs::path target_, name_;
    bool published_ = false;
};

/// Writes a whole file atomically. Throws RunError.
void write_file(const fs::path& path, std::string_view content, bool durable) {
    TemporaryFile temporary(path);
    const int descriptor = ::open(temporary.name().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (descriptor < 0)
        throw RunError(fmt::format("{}: cannot create: {}", path.string(), std::strerror(errno)));
    std::size_t written = 0;
    while (written < content.size()) {
        const ssize_t count = ::write(descriptor, content.data() + written, content.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) {
            const int reason = errno;
            ::close(descriptor);
            throw RunError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(reason)));
        }
        written += static_cast<std::size_t>(count);
    }
    if (::close(descriptor) != 0)
        throw RunError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
    temporary.publish(durable);
}

// ---------------------------------------------------------------- reading

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

Attribute read_attribute(hid_t object, const std::string& name, const fs::path& path) {
    Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!attribute.is_valid()) refuse(path, "cannot read attribute " + name);
    Handle type(H5Aget_type(attribute), H5Tclose);
    Handle space(H5Aget_space(attribute), H5Sclose);
    constexpr std::size_t longest = 1 << 20;
    if (H5Sget_simple_extent_npoints(space) != 1 || H5Tget_size(type) > longest)
        refuse(path, "attribute " + name + " is not one text or number");
    switch (H5Tget_class(type)) {
        case H5T_STRING: {
            if (H5Tis_variable_str(type) > 0) {
                char* text = nullptr;
                if (H5Aread(attribute, type, &text) < 0 || text == nullptr)
                    refuse(path, "cannot read attribute " + name);
                std::string value(text);
                H5free_memory(text);
                return value;
            }
            std::string value(H5Tget_size(type), '\0');
            if (H5Aread(attribute, type, value.data()) < 0) refuse(path, "cannot read attribute " + name);
            value.resize(std::strlen(value.c_str()));
            return value;
        }
        case H5T_FLOAT: {
            double value = 0;
            if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
                refuse(path, "cannot read attribute " + name);
            return value;
        }
        case H5T_INTEGER: {
            std::int64_t value = 0;
            if (H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
                refuse(path, "cannot read attribute " + name);
            return value;
        }
        default:
            refuse(path, "attribute " + name + " is neither text nor a number");
    }
}

template <class T>
std::vector<T> read_values(hid_t set, std::size_t count, const std::string& name, const fs::path& path) {
    std::vector<T> values(count);
    if (count > 0 && H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        refuse(path, "dataset " + name + " cannot be read (damaged?)");
    return values;
}

/// True where values are stored smaller than they are.
bool is_compressed(hid_t set) {
    Handle creation(H5Dget_create_plist(set), H5Pclose);
    const int filters = H5Pget_nfilters(creation);
    for (int i = 0; i < filters; ++i) {
        unsigned flags = 0, configuration = 0;
        std::size_t words = 0;
        const H5Z_filter_t filter = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &words,
                                                   nullptr, 0, nullptr, &configuration);
        if (filter != H5Z_FILTER_FLETCHER32 && filter != H5Z_FILTER_SHUFFLE) return true;
    }
    return false;
}

/// Unit and shape, and with `has_values` the values.
Dataset read_dataset(hid_t file, const std::string& name, const fs::path& path, bool has_values) {
    Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set.is_valid()) refuse(path, "dataset " + name + " cannot be opened (damaged?)");
    Handle space(H5Dget_space(set), H5Sclose);
    Dataset dataset;
    std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    if (!extent.empty()) H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    dataset.shape.assign(extent.begin(), extent.end());
    Handle type(H5Dget_type(set), H5Tclose);
    const std::size_t width = H5Tget_size(type);
    std::size_t count = 1, bytes = 0;
    bool overflows = false;
    for (const std::size_t length : dataset.shape)
        overflows = __builtin_mul_overflow(count, length, &count) || overflows;
    overflows = __builtin_mul_overflow(count, width, &bytes) || overflows;
    if (std::find(dataset.shape.begin(), dataset.shape.end(), 0) != dataset.shape.end())
        count = 0, bytes = 0, overflows = false;
    // A damaged header may claim any size: nothing is allocated for data that cannot be in the file. No
    // compression that HDF5 knows makes more than 1032 bytes out of one, but for repeated passes.
    constexpr std::size_t most_out_of_one = 2048;
    const std::size_t stored = std::min<std::size_t>(H5Dget_storage_size(set), fs::file_size(path));
    if (width == 0 || overflows || (is_compressed(set) ? bytes / most_out_of_one > stored : bytes > stored))
        refuse(path, "dataset " + name + " claims more values than the file holds");
    if (H5Aexists(set, "units") > 0) {
        const Attribute unit = read_attribute(set, "units", path);
        if (const auto* text = std::get_if<std::string>(&unit)) dataset.unit = *text;
    }
    if (!has_values) return dataset;
    if (H5Tget_class(type) == H5T_FLOAT && width <= 4)
        dataset.values = read_values<float>(set, count, name, path);
    else if (H5Tget_class(type) == H5T_FLOAT)
        dataset.values = read_values<double>(set, count, name, path);
    else if (H5Tget_class(type) == H5T_INTEGER && width <= 4)
        dataset.values = read_values<std::int32_t>(set, count, name, path);
    else if (H5Tget_class(type) == H5T_INTEGER)
        dataset.values = read_values<std::uint64_t>(set, count, name, path);
    else
        refuse(path, "dataset " + name + " is not numbers");
    return dataset;
}

/// Tells what cannot be read (permission, a disk at fault) from what is damaged.
void require_readable(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
    char byte = 0;
    const bool is_read = ::read(descriptor, &byte, 1) >= 0;
    const int reason = errno;
    ::close(descriptor);
    if (!is_read) refuse(path, fmt::format("cannot be read: {}", std::strerror(reason)));
}

struct Listing {
    std::vector<std::string> datasets;
};

herr_t list_dataset(hid_t, const char* name, const H5O_info_t* info, void* listing) {
    if (info->type == H5O_TYPE_DATASET)
        static_cast<Listing*>(listing)->datasets.push_back(std::string("/") + name);
    return 0;
}

herr_t list_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
    static_cast<std::vector<std::string>*>(names)->push_back(name);
    return 0;
}

}  // namespace

std::size_t Dataset::size() const {
    return std::visit([](const auto& held) { return held.size(); }, values);
}

std::vector<double> Dataset::as_double() const {
    return std::visit(
        [](const auto& held) {
            std::vector<double> result(held.size());
            for (std::size_t i = 0; i < held.size(); ++i) result[i] = static_cast<double>(held[i]);
            return result;
        },
        values);
}

Dataset real64(std::string unit, std::vector<std::size_t> shape, std::vector<double> values) {
    return {std::move(unit), std::move(shape), std::move(values)};
}
Dataset real32(std::string unit, std::vector<std::size_t> shape, std::vector<float> values) {
    return {std::move(unit), std::move(shape), std::move(values)};
}
Dataset real32(std::string unit, std::vector<std::size_t> shape, std::span<const double> values) {
    std::vector<float> narrowed(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) narrowed[i] = static_cast<float>(values[i]);
    return {std::move(unit), std::move(shape), std::move(narrowed)};
}
Dataset integer32(std::string unit, std::vector<std::size_t> shape, std::vector<std::int32_t> values) {
    return {std::move(unit), std::move(shape), std::move(values)};
}
Dataset unsigned64(std::vector<std::size_t> shape, std::vector<std::uint64_t> values) {
    return {"-", std::move(shape), std::move(values)};
}

const Dataset& DataFile::at(const std::string& dataset) const {
    const auto found = datasets.find(dataset);
    if (found == datasets.end()) throw InputError("dataset " + dataset + " is missing");
    return found->second;
}

namespace {
template <class T>
const T& attribute_as(const std::map<std::string, Attribute>& attributes, const std::string& name,
                      const char* kind) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) throw InputError("attribute " + name + " is missing");
    const T* value = std::get_if<T>(&found->second);
    if (value == nullptr) throw InputError("attribute " + name + " is not " + kind);
    return *value;
}
}  // namespace

std::string DataFile::text(const std::string& attribute) const {
    return attribute_as<std::string>(attributes, attribute, "text");
}
double DataFile::number(const std::string& attribute) const {
    return attribute_as<double>(attributes, attribute, "a number");
}
std::int64_t DataFile::integer(const std::string& attribute) const {
    return attribute_as<std::int64_t>(attributes, attribute, "a whole number");
}

void write_data_file(const fs::path& path, const DataFile& content) {
    silence_library_messages();
    // The file is built in memory and written by our own checked calls: on a full disk the library's flush
    // and close may report success.
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    MemoryImage image(access);
    {
        Handle root(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
        H5Pset_obj_track_times(root, 0);
        // A name of its own: creating over an existing file would first read all of that file.
        const std::string name_in_memory = path.string() + ".in_memory";
        Handle file(H5Fcreate(name_in_memory.c_str(), H5F_ACC_TRUNC, root, access), H5Fclose);
        require_built(file.is_valid(), path, "the file");
        for (const auto& [name, value] : content.attributes) write_attribute(file, name, value, path);
        for (const auto& [name, dataset] : content.datasets) write_dataset(file, name, dataset, path);
        require_built(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, path, "the file");
    }
    require_built(!image.bytes().empty(), path, "the file");
    write_file(path, image.bytes(), true);
}

DataFile read_data_file(const fs::path& path, const std::function<void(const DataFile&)>& accept) {
    silence_library_messages();
    std::error_code error;
    const bool is_there = fs::is_regular_file(path, error);
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
        refuse(path, "cannot be read: " + error.message());
    if (!is_there) refuse(path, "no such file");
    require_readable(path);
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
#if H5_VERSION_GE(1, 10, 7)
    // Files are replaced by renaming, never changed where they are: locks guard nothing, and some file
    // systems have none.
    H5Pset_file_locking(access, false, true);
#endif
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
    if (!file.is_valid()) refuse(path, "not a whole HDF5 file (truncated or damaged)");
    DataFile content;
    std::vector<std::string> names;
    if (H5Aiterate2(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, list_attribute, &names) < 0)
        refuse(path, "cannot list its attributes (damaged?)");
    for (const auto& name : names) content.attributes.emplace(name, read_attribute(file, name, path));
    Listing listing;
    if (H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, list_dataset, &listing) < 0)
        refuse(path, "cannot list its datasets (damaged?)");
    const auto read_datasets = [&](bool has_values) {
        for (const auto& name : listing.datasets)
            content.datasets.insert_or_assign(name, read_dataset(file, name, path, has_values));
    };
    if (accept) {
        read_datasets(false);
        accept(content);
    }
    read_datasets(true);
    return content;
}

void write_text_file(const fs::path& path, std::string_view content) {
    write_file(path, content, false);
}

}  // namespace common
