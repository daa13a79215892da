/*
 * The C++ wrapper seen through the tables that it makes, as a host of any version sees it.
 */
#include <elvis/plugin.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cstddef>

using namespace elvis;

namespace {

/** What the wrapper tells the host. */
struct Said {
    std::string file;
    std::string message;
    bool cancel = false;
};
Said said;

const elvis_host host{sizeof(elvis_host),
                      ELVIS_ABI_VERSION,
                      nullptr,
                      [](const elvis_host*, elvis_log_level, const char*) {},
                      [](const elvis_host*, double, const char*) {},
                      [](const elvis_host*) -> std::int32_t { return said.cancel; },
                      [](const elvis_host*, const char* file, const char* message) {
                          said.file = file ? file : "(none)";
                          said.message = message;
                      }};

/** A volume with every required function; get_time throws what it is asked for. */
class Plain : public api::RuntimeVolume {
public:
    static int n_open;
    static std::uint32_t probe(const char* path) {
        if (std::string_view(path) == "broken") {
            throw std::runtime_error("probing broke");
        }
        return 42;
    }
    Plain(const api::Host& table, const std::string& path, const std::string& options) : RuntimeVolume(table) {
        if (path == "missing") {
            throw api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
        m_options = options;
        ++n_open;
    }
    ~Plain() override { --n_open; }

    void get_info(elvis_volume_info& info) override { info.n_elements = m_options.size(); }
    void get_class(std::uint32_t, elvis_element_class&) override {}
    void get_field(std::uint32_t, elvis_field& out) override {
        out.name = "f";
        out.n_components = 2;
    }
    void get_class_field(std::uint32_t, std::uint32_t, elvis_class_field&) override {}
    double get_time(std::uint32_t step) override {
        switch (step) {
        case 0:
            return 1.5;
        case 1:
            throw std::bad_alloc();
        case 2:
            throw std::out_of_range("step 2 is too far");
        case 3:
            throw 3;
        default:
            host().check_cancelled();
            return 4;
        }
    }
    void get_buffer(std::uint32_t, std::uint32_t, elvis_buffer&) override {}
    void get_snippet(std::uint32_t, elvis_snippet&) override {}
    elvis_certainty get_bounds(std::uint64_t, std::uint64_t, std::span<double> bounds) override {
        std::fill(bounds.begin(), bounds.end(), 7.0);
        return ELVIS_ESTIMATED;
    }
    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        *static_cast<double*>(destination) = request.origins ? request.origins[0] : -1;
    }

private:
    std::string m_options;
};
int Plain::n_open = 0;

class Full : public Plain {
public:
    using Plain::Plain;
    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            elvis_face face{};
            face.element = static_cast<std::int64_t>(first + i);
            face.neighbour_local_face = 5;
            faces.set(i, face);
        }
    }
    elvis_certainty get_field_ranges(std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t, std::span<double> ranges) {
        std::fill(ranges.begin(), ranges.end(), static_cast<double>(ranges.size()));
        return ELVIS_CERTIFIED;
    }
    elvis_certainty get_field_derivative_bounds(std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t,
                                                std::span<double> bounds) {
        std::fill(bounds.begin(), bounds.end(), 0.5 * static_cast<double>(bounds.size()));
        return ELVIS_ESTIMATED;
    }
    elvis_certainty check_jacobians(std::uint64_t first, double tolerance, api::StructArray<elvis_jacobian_check> checks) {
        for (std::uint64_t i = 0; i < checks.size(); ++i) {
            elvis_jacobian_check check{};
            check.sign = ELVIS_JACOBIAN_NEGATIVE;
            check.determinant = -static_cast<double>(first + i);
            check.lower = tolerance;
            checks.set(i, check);
        }
        return ELVIS_CERTIFIED;
    }
};

class WorldSource : public api::ConverterSource {
public:
    static std::uint32_t probe(const char*) { return 1; }
    WorldSource(const api::Host& table, const std::vector<std::string>&, const std::string&) : ConverterSource(table) {}
    void get_info(elvis_source_info&) override {}
    void get_field(std::uint32_t, elvis_source_field&) override {}
    void get_elements(std::uint64_t, api::StructArray<elvis_source_element>) override {}
    void get_spaces(std::uint32_t, std::uint64_t, api::StructArray<elvis_source_space>) override {}
    void evaluate_mapping(std::uint64_t, std::span<const double>, std::span<double>) override {}
    void sample_world(std::uint32_t, std::uint64_t, std::span<const double>, double*) {}
};

const elvis_runtime& plain = *api::runtime_table<Plain>();
const elvis_runtime& full = *api::runtime_table<Full>();

/** An open volume that closes itself. */
class Open {
public:
    explicit Open(const elvis_runtime& table, const char* options = nullptr) : m_table(table) {
        REQUIRE(table.open(&host, "path", options, &m_volume) == ELVIS_OK);
    }
    ~Open() { m_table.close(m_volume); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
    operator elvis_volume*() const { return m_volume; }

private:
    const elvis_runtime& m_table;
    elvis_volume* m_volume = nullptr;
};

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.test.wrapper", .name = "Wrapper", .version = "1.0.0", .runtime = api::runtime_table<Plain>());

TEST_CASE("the macro exports a complete descriptor") {
    const elvis_plugin_descriptor* descriptor = elvis_plugin_get_descriptor();
    REQUIRE(descriptor);
    CHECK(descriptor->struct_size == sizeof(elvis_plugin_descriptor));
    CHECK(descriptor->abi_version == ELVIS_ABI_VERSION);
    CHECK(std::string(descriptor->id) == "org.elvis.test.wrapper");
    CHECK(descriptor->vendor == nullptr);
    CHECK(descriptor->get_interface(ELVIS_RUNTIME_INTERFACE) == &plain);
    CHECK(descriptor->get_interface(ELVIS_CONVERTER_INTERFACE) == nullptr);
    CHECK(descriptor->get_interface("elvis.runtime/2") == nullptr);
}

TEST_CASE("optional functions are in the table exactly if the class has them") {
    CHECK(full.get_faces);
    CHECK(full.get_field_ranges);
    CHECK(full.get_field_derivative_bounds);
    CHECK(full.check_jacobians);
    CHECK_FALSE(plain.check_jacobians);
    CHECK_FALSE(full.get_note);
    CHECK_FALSE(plain.get_faces);
    CHECK_FALSE(plain.get_element_numbers);
    CHECK_FALSE(plain.get_boundary_group);
    CHECK_FALSE(plain.get_field_ranges);
    CHECK_FALSE(plain.evaluate_mapping);
    CHECK_FALSE(plain.evaluate_field);
    CHECK_FALSE(plain.get_field_derivative_bounds);
    const elvis_converter& converter = *api::converter_table<WorldSource>();
    CHECK_FALSE(converter.sample);
    CHECK(converter.sample_world);
    CHECK_FALSE(converter.get_time);
}

TEST_CASE("no exception leaves a call, and each becomes its code and text") {
    std::uint32_t confidence = 0;
    CHECK(plain.probe(&host, "file", &confidence) == ELVIS_OK);
    CHECK(confidence == 42);
    CHECK(plain.probe(&host, "broken", &confidence) == ELVIS_ERROR_FAILED);
    CHECK(said.message == "probing broke");
    elvis_volume* none = nullptr;
    CHECK(plain.open(&host, "missing", nullptr, &none) == ELVIS_ERROR_FILE);
    CHECK(none == nullptr);
    CHECK(said.file == "missing");
    CHECK(said.message == "cannot be read");

    const Open volume(plain);
    double time = 0;
    CHECK(plain.get_time(volume, 0, &time) == ELVIS_OK);
    CHECK(time == 1.5);
    CHECK(plain.get_time(volume, 1, &time) == ELVIS_ERROR_OUT_OF_MEMORY);
    CHECK(plain.get_time(volume, 2, &time) == ELVIS_ERROR_FAILED);
    CHECK(said.message == "step 2 is too far");
    CHECK(said.file == "(none)");
    CHECK(plain.get_time(volume, 3, &time) == ELVIS_ERROR_FAILED);
    said.cancel = true;
    CHECK(plain.get_time(volume, 4, &time) == ELVIS_ERROR_CANCELLED);
    said.cancel = false;
    CHECK(plain.get_time(volume, 4, &time) == ELVIS_OK);
}

TEST_CASE("close destroys what open made") {
    {
        const Open volume(plain, "{}");
        CHECK(Plain::n_open == 1);
        elvis_volume_info info{};
        info.struct_size = sizeof info;
        CHECK(plain.get_info(volume, &info) == ELVIS_OK);
        CHECK(info.n_elements == 2);
    }
    CHECK(Plain::n_open == 0);
}

TEST_CASE("an older host's smaller struct is not written beyond its end") {
    const Open volume(plain);
    std::array<unsigned char, sizeof(elvis_field)> bytes;
    bytes.fill(0xab);
    auto* field = reinterpret_cast<elvis_field*>(bytes.data());
    const std::size_t size = offsetof(elvis_field, unit);
    field->struct_size = static_cast<std::uint32_t>(size);
    CHECK(plain.get_field(volume, 0, field) == ELVIS_OK);
    CHECK(field->struct_size == size);
    CHECK(std::string(field->name) == "f");
    for (std::size_t i = size; i < bytes.size(); ++i) {
        CHECK(bytes[i] == 0xab);
    }
}

TEST_CASE("a newer host's larger struct keeps what the plugin does not know or set") {
    const Open volume(plain);
    struct NewerField {
        elvis_field known;
        double future;
    } field{};
    field.known.struct_size = sizeof field;
    field.known.max_jump = 0.25;
    field.future = 0.5;
    CHECK(plain.get_field(volume, 0, &field.known) == ELVIS_OK);
    CHECK(field.known.struct_size == sizeof field);
    CHECK(field.known.n_components == 2);
    CHECK(field.known.max_jump == 0.25);
    CHECK(field.future == 0.5);
}

TEST_CASE("arrays of structs are walked with the host's stride") {
    const Open volume(full);
    struct NewerFace {
        elvis_face known;
        std::uint64_t future;
    };
    std::array<NewerFace, 3> newer{};
    for (NewerFace& face : newer) {
        face = {elvis_face{}, 77};
        face.known.struct_size = sizeof face;
    }
    CHECK(full.get_faces(volume, 10, newer.size(), &newer[0].known) == ELVIS_OK);
    for (std::size_t i = 0; i < newer.size(); ++i) {
        CHECK(newer[i].known.struct_size == sizeof(NewerFace));
        CHECK(newer[i].known.element == static_cast<std::int64_t>(10 + i));
        CHECK(newer[i].known.neighbour_local_face == 5);
        CHECK(newer[i].future == 77);
    }
    // Entries of an older host that end before neighbour_local_face (and stay aligned).
    constexpr std::size_t stride = offsetof(elvis_face, local_face);
    alignas(elvis_face) std::array<unsigned char, 3 * stride + sizeof(elvis_face)> bytes{};
    for (std::size_t i = 0; i < 3; ++i) {
        reinterpret_cast<elvis_face*>(bytes.data() + i * stride)->struct_size = stride;
    }
    CHECK(full.get_faces(volume, 20, 3, reinterpret_cast<elvis_face*>(bytes.data())) == ELVIS_OK);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(reinterpret_cast<elvis_face*>(bytes.data() + i * stride)->element == static_cast<std::int64_t>(20 + i));
        CHECK(reinterpret_cast<elvis_face*>(bytes.data() + i * stride)->struct_size == stride);
    }
    CHECK(std::all_of(bytes.begin() + 3 * stride, bytes.end(), [](unsigned char byte) { return byte == 0; }));
}

TEST_CASE("a request of an older host has zeros for what it does not know") {
    const Open volume(plain);
    const double origin = 9;
    double number = 0;
    elvis_fill_request request{};
    request.origins = &origin;
    request.struct_size = sizeof request;
    CHECK(plain.fill_buffer(volume, &request, &number) == ELVIS_OK);
    CHECK(number == 9);
    request.struct_size = offsetof(elvis_fill_request, origins);
    CHECK(plain.fill_buffer(volume, &request, &number) == ELVIS_OK);
    CHECK(number == -1);
}

TEST_CASE("spans have the size that the call implies") {
    const Open volume(full);
    std::array<double, 13> bounds{};
    elvis_certainty certainty = ELVIS_CERTIFIED;
    CHECK(full.get_bounds(volume, 0, 2, bounds.data(), &certainty) == ELVIS_OK);
    CHECK(certainty == ELVIS_ESTIMATED);
    CHECK(bounds[11] == 7);
    CHECK(bounds[12] == 0);
    std::array<double, 13> ranges{};
    CHECK(full.get_field_ranges(volume, 0, 0, 0, 3, ranges.data(), &certainty) == ELVIS_OK);
    CHECK(ranges[11] == 12); // three elements, two components, two ends
    CHECK(ranges[12] == 0);
    std::array<double, 13> derivative_bounds{};
    CHECK(full.get_field_derivative_bounds(volume, 0, 0, 0, 3, derivative_bounds.data(), &certainty) == ELVIS_OK);
    CHECK(certainty == ELVIS_ESTIMATED);
    CHECK(derivative_bounds[11] == 6); // three elements, two components, two numbers
    CHECK(derivative_bounds[12] == 0);
}

TEST_CASE("signs of Jacobians are written into structs of the host's size") {
    const Open volume(full);
    std::array<elvis_jacobian_check, 2> checks{};
    for (elvis_jacobian_check& check : checks)
        check.struct_size = sizeof check;
    elvis_certainty certainty = ELVIS_ESTIMATED;
    CHECK(full.check_jacobians(volume, 4, 2, 0.25, checks.data(), &certainty) == ELVIS_OK);
    CHECK(certainty == ELVIS_CERTIFIED);
    CHECK(checks[1].struct_size == sizeof checks[1]);
    CHECK(checks[1].sign == ELVIS_JACOBIAN_NEGATIVE);
    CHECK(checks[1].determinant == -5);
    CHECK(checks[1].lower == 0.25);
}
