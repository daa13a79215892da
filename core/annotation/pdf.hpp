/**
 * @file pdf.hpp
 * Annotation as text and shapes of a PDF.
 */
#pragma once

#include <core/annotation/pdf_file.hpp>
#include <core/annotation/plan.hpp>

#include <string>

namespace elvis {

struct PdfDrawing {
    /** In pixels of the picture, from its upper left corner, y downwards. */
    std::string operators;
    /** What they refer to: entries of a dictionary of resources. XObjects are another entry's. */
    std::string resources;
    /** Entries of the dictionary of XObjects. */
    std::string objects;
};

/** The plan in the colours that paint() would take on the picture, as svg_elements() draws it. */
PdfDrawing pdf_drawing(const AnnotationPlan& plan, const Frame& frame, PdfFile& file);

} // namespace elvis
