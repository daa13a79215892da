/**
 * @file vtkElVisRepresentation.h
 * Surfaces of a volume in a view of ParaView, drawn by libelvis.
 */
#ifndef vtkElVisRepresentation_h
#define vtkElVisRepresentation_h

#include "ElVisRepresentationModule.h"

#include <vtkPVDataRepresentation.h>
#include <vtkSmartPointer.h>

#include <memory>

class vtkScalarsToColors;

/**
 * The input is what a vtkElVisReader gives, for which the volume itself is drawn; of anything else nothing is, with an error.
 * Fields are chosen and coloured as those of other representations: by ColorArrayName and LookupTable.
 */
class ELVISREPRESENTATION_EXPORT vtkElVisRepresentation : public vtkPVDataRepresentation {
public:
    static vtkElVisRepresentation* New();
    vtkTypeMacro(vtkElVisRepresentation, vtkPVDataRepresentation);

    int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;
    void SetVisibility(bool is_visible) override;
    using vtkAlgorithm::SetInputArrayToProcess;
    void SetInputArrayToProcess(int index, int port, int connection, int association, const char* name) override;
    /** Null: one colour. */
    void SetLookupTable(vtkScalarsToColors* colors);
    /** Of surfaces without a field. */
    void SetDiffuseColor(double red, double green, double blue);

    void SetBoundary(bool is_shown);
    void SetMeshLines(bool are_shown);
    void SetLighting(bool is_on);
    /** The volume itself, by the opacity function of the lookup table. */
    void SetVolume(bool is_shown);
    /** Length that the opacity is over; 0: a twentieth of the diagonal of the bounds. */
    void SetOpacityUnitDistance(double length);
    /** Evaluation in double precision. */
    void SetDoublePrecision(bool is_on);
    /** a, b, c, d of ax + by + cz + d = 0. */
    void AddCutPlane(double a, double b, double c, double d);
    void ClearCutPlanes();
    /** Boundary and isosurfaces are cut away where ax + by + cz + d < 0, for any of these. */
    void AddClipPlane(double a, double b, double c, double d);
    void ClearClipPlanes();
    void AddIsovalue(double value);
    void ClearIsovalues();
    /** A field, or an expression over fields; "": the one that colours. */
    void SetIsosurfaceField(const char* field);
    void AddContour(double value);
    void ClearContours();

    /** What the last picture's counts say, in sentences. */
    const char* GetRemarks();
    /** The scene of the last picture: a file for `elvis render`. */
    const char* GetScene();

protected:
    vtkElVisRepresentation();
    ~vtkElVisRepresentation() override;

    int FillInputPortInformation(int port, vtkInformation* info) override;
    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
    bool AddToView(vtkView* view) override;
    bool RemoveFromView(vtkView* view) override;

private:
    vtkElVisRepresentation(const vtkElVisRepresentation&) = delete;
    void operator=(const vtkElVisRepresentation&) = delete;

    struct State;
    void Change();

    std::unique_ptr<State> Internals;
};

#endif
