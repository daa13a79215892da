#include "plain_driver.hpp"

#include <compare>
#include <memory>
#include <tuple>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace elvis::hdf5 {

namespace {

using native::h5::Handle;

/** HDF5 sees the first member only. */
struct OpenFile {
    H5FD_t common{};
    int descriptor = -1;
    haddr_t size = 0;
    /** Of the part that HDF5 uses. */
    haddr_t end = 0;
    dev_t device = 0;
    ino_t node = 0;

    explicit OpenFile(const char* path) : descriptor(::open(path, O_RDONLY | O_CLOEXEC)) {}
    ~OpenFile() {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
};

const OpenFile& opened(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open_file(const char* path, unsigned flags, hid_t, haddr_t) {
    auto file = std::make_unique<OpenFile>(path);
    struct stat status {};
    if ((flags & H5F_ACC_RDWR) != 0 || file->descriptor < 0 || fstat(file->descriptor, &status) != 0) {
        return nullptr;
    }
    file->size = static_cast<haddr_t>(status.st_size);
    file->device = status.st_dev;
    file->node = status.st_ino;
    return &file.release()->common;
}

herr_t close_file(H5FD_t* file) {
    delete reinterpret_cast<OpenFile*>(file);
    return 0;
}

int compare_files(const H5FD_t* a, const H5FD_t* b) {
    const auto order = std::tuple(opened(a).device, opened(a).node) <=> std::tuple(opened(b).device, opened(b).node);
    return std::is_lt(order) ? -1 : std::is_gt(order) ? 1 : 0;
}

herr_t read_file(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
    const OpenFile& from = opened(file);
    if (address > from.size || size > from.size - address) {
        return -1;
    }
    auto* to = static_cast<char*>(buffer);
    while (size > 0) {
        const ssize_t n = pread(from.descriptor, to, size, static_cast<off_t>(address));
        if (n <= 0) {
            return -1;
        }
        to += n;
        address += static_cast<haddr_t>(n);
        size -= static_cast<std::size_t>(n);
    }
    return 0;
}

H5FD_class_t make_driver() {
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
    driver.version = H5FD_CLASS_VERSION;
#endif
    driver.name = "elvis-plain";
    driver.maxaddr = haddr_t{1} << 62;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.open = open_file;
    driver.close = close_file;
    driver.cmp = compare_files;
    driver.query = [](const H5FD_t*, unsigned long* flags) -> herr_t {
        *flags = H5FD_FEAT_DATA_SIEVE;
        return 0;
    };
    driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return opened(file).end; };
    driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t end) -> herr_t {
        reinterpret_cast<OpenFile*>(file)->end = end;
        return 0;
    };
    driver.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return opened(file).size; };
    driver.read = read_file;
    // HDF5 demands it of every driver; files opened for reading have nothing to write.
    driver.write = [](H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) -> herr_t { return -1; };
    for (H5FD_mem_t& kind : driver.fl_map) {
        kind = H5FD_MEM_SUPER;
    }
    return driver;
}

} // namespace

Handle open_plainly(const std::string& path) {
    // Never taken back: HDF5 uses a driver after its last file has let it go (H5FD_close).
    static const hid_t driver = [] {
        const H5FD_class_t description = make_driver();
        return H5FDregister(&description);
    }();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (driver < 0 || !access.is_valid() || H5Pset_driver(access.id(), driver, nullptr) < 0) {
        return {};
    }
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose};
}

} // namespace elvis::hdf5
