! code_saturne without a GUI file wants this subroutine to be there; the conditions are set in cs_user_boundary_conditions.c.
subroutine cs_f_user_boundary_conditions(nvar, nscal, icodcl, itrifb, itypfb, izfppp, dt, rcodcl)
   implicit none
   integer :: nvar, nscal, icodcl(*), itrifb(*), itypfb(*), izfppp(*)
   double precision :: dt(*), rcodcl(*)
end subroutine cs_f_user_boundary_conditions
