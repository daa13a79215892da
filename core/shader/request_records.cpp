#include <core/shader/request_records.hpp>

#include <algorithm>

namespace elvis {

RequestRecords::RequestRecords(const KernelRequest& request)
    : m_first_binding(static_cast<std::uint32_t>(request.bindings.size())) {
    add_all(request.buffers);
    for (const SnippetInstance& instance : request.instances) {
        add_all(instance.buffers);
        if (instance.origins != nullptr) {
            add(instance.origins);
        }
    }
}

std::uint32_t RequestRecords::number(const RecordBuffer* records) const {
    return static_cast<std::uint32_t>(std::find(m_records.begin(), m_records.end(), records) - m_records.begin());
}

std::vector<BoundBuffer> RequestRecords::bindings() const {
    std::vector<BoundBuffer> bound;
    auto binding = m_first_binding;
    for (const RecordBuffer* buffer : m_records) {
        for (std::uint32_t part = 0; part < buffer->n_parts(); ++part) {
            bound.push_back({binding++, nullptr, buffer, part});
        }
    }
    return bound;
}

void RequestRecords::add(const RecordBuffer* records) {
    if (std::find(m_records.begin(), m_records.end(), records) == m_records.end()) {
        m_records.push_back(records);
    }
}

void RequestRecords::add_all(const std::vector<FetchBuffer>& buffers) {
    for (const FetchBuffer& buffer : buffers) {
        add(buffer.records);
    }
}

} // namespace elvis
