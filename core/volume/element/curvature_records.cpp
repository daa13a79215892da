#include <core/volume/element/curvature_records.hpp>

#include <algorithm>
#include <span>

namespace elvis {

namespace {

/** Three, and four, vectors of four numbers. */
constexpr std::uint32_t bends_size = 12, forms_size = 16;
/** Elements that are written at once. */
constexpr std::size_t curvature_block = 1u << 16;

void write_bends(const RecordBuffer& records, std::span<const ElementBends> bends) {
    std::vector<double> numbers;
    for (std::size_t first = 0; first < bends.size(); first += curvature_block) {
        numbers.clear();
        for (const ElementBends& of : bends.subspan(first, std::min(curvature_block, bends.size() - first))) {
            for (std::size_t m = 0; m < of.vectors.size(); m += 3) {
                numbers.insert(numbers.end(), {of.vectors[m], of.vectors[m + 1], of.vectors[m + 2], 0.0});
            }
        }
        records.write_reals(first, numbers);
    }
}

bool has_form(const ElementBends& bends) { return bends.form.lengths[0] > 0; }

void write_forms(const RecordBuffer& records, std::span<const ElementBends> bends) {
    std::vector<double> numbers;
    for (std::size_t first = 0; first < bends.size(); first += curvature_block) {
        numbers.clear();
        for (const ElementBends& of : bends.subspan(first, std::min(curvature_block, bends.size() - first))) {
            for (const SymmetricMatrix& m : {of.form.lengths, of.form.ways}) {
                numbers.insert(numbers.end(), {m[0], m[3], m[5], 0.0, m[1], m[2], m[4], 0.0});
            }
        }
        records.write_reals(first, numbers);
    }
}

} // namespace

void CurvatureRecords::write(const Device& device, Precision precision, const ElementCurvatures& curvatures) {
    const std::size_t n_elements = curvatures.numbers.size();
    std::vector<double> numbers;
    numbers.reserve(2 * n_elements);
    for (std::size_t element = 0; element < n_elements; ++element) {
        numbers.insert(numbers.end(), {curvatures.numbers[element], curvatures.are_proven[element] ? 1.0 : 0.0});
    }
    if (!m_curvatures) {
        m_curvatures = std::make_unique<RecordBuffer>(device, RecordKind::real, precision, n_elements, 2);
    }
    m_curvatures->write_reals(0, numbers);
    if (!m_bends && !curvatures.bends.empty()) {
        m_bends = std::make_unique<RecordBuffer>(device, RecordKind::real, precision, n_elements, bends_size);
    }
    if (m_bends) {
        write_bends(*m_bends, curvatures.bends.empty() ? std::vector<ElementBends>(n_elements) : curvatures.bends);
    }
    if (!m_forms && std::ranges::any_of(curvatures.bends, has_form)) {
        m_forms = std::make_unique<RecordBuffer>(device, RecordKind::real, precision, n_elements, forms_size);
    }
    if (m_forms) {
        write_forms(*m_forms, curvatures.bends.empty() ? std::vector<ElementBends>(n_elements) : curvatures.bends);
    }
}

std::vector<FetchBuffer> CurvatureRecords::buffers() const {
    std::vector<FetchBuffer> buffers = bends();
    buffers.push_back({"core_curvatures", m_curvatures.get()});
    return buffers;
}

std::vector<FetchBuffer> CurvatureRecords::bends() const {
    return m_bends ? std::vector<FetchBuffer>{{"core_bends", m_bends.get()}} : std::vector<FetchBuffer>{};
}

std::vector<FetchBuffer> CurvatureRecords::forms() const {
    return m_forms ? std::vector<FetchBuffer>{{"core_bend_forms", m_forms.get()}} : std::vector<FetchBuffer>{};
}

std::uint64_t CurvatureRecords::bytes() const {
    return (m_curvatures ? m_curvatures->bytes() : 0) + (m_bends ? m_bends->bytes() : 0) + (m_forms ? m_forms->bytes() : 0);
}

} // namespace elvis
